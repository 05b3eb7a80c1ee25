// SPDX-License-Identifier: MIT
// Plugins of others, loaded in a process of their own first: loading runs their code, and what ends
// the process then is no error that a host could catch.
#pragma once

#include <chrono>
#include <string>

namespace grisaille::effect {

// Loads, checks and unloads the plugin in another process. Throws kPluginCrashes unless that
// process lives through it in time; what else is wrong with the plugin is for the registry to say.
void probe(const std::string& path, std::chrono::milliseconds patience = std::chrono::seconds(10));

// How that process says that it came to its end: no plugin is likely to exit with this.
constexpr int kProbeSurvived = 83;

}  // namespace grisaille::effect
