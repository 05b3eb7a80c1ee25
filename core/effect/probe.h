// SPDX-License-Identifier: MIT
// Plugins of others, loaded in a process of their own first: loading runs their code, and what ends
// the process then is no error that a host could catch.
#pragma once

#include <chrono>
#include <string>

namespace grisaille::effect {

// Loads and checks the plugin at `path` in another process, and unloads it there if it is accepted.
// Throws the error by which the registry of that process refuses the plugin, so that nothing of it
// is loaded here. Throws kPluginCrashes if that process crashes, exits early or takes longer than
// `patience`.
void probe(const std::string& path, std::chrono::milliseconds patience = std::chrono::seconds(10));

// Exit statuses of that process, which no plugin is likely to exit with. A refusing process writes
// the error's number, a space and its detail to kProbeAnswer.
constexpr int kProbeAccepted = 83, kProbeRefused = 84;
constexpr int kProbeAnswer = 3;  // file descriptor

}  // namespace grisaille::effect
