// SPDX-License-Identifier: MIT
// Loads third-party plugins in a separate process first: loading runs a plugin's code, and a host
// cannot catch a crash in it.
#pragma once

#include <chrono>
#include <string>

namespace grisaille::effect {

// Loads and checks the plugin at `path` in another process, and unloads it there if it is accepted.
// If the registry of that process refuses the plugin, throws the same error here; this process then
// does not load the plugin. Throws kPluginCrashes if that process crashes, exits early or takes
// longer than `patience`.
void probe(const std::string& path, std::chrono::milliseconds patience = std::chrono::seconds(10));

// Exit statuses of that process, which a plugin is unlikely to exit with. A process that refuses
// the plugin writes the error's number, a space and its detail to kProbeAnswer.
constexpr int kProbeAccepted = 83, kProbeRefused = 84;
constexpr int kProbeAnswer = 3;  // file descriptor

}  // namespace grisaille::effect
