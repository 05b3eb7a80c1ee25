// SPDX-License-Identifier: MIT
// grisaille_probe_plugin FILE: loads and checks a plugin, and unloads it if it is accepted. Its
// exit status tells the result. See probe.h.
#include <sys/resource.h>
#include <unistd.h>

#include <string>

#include "core/effect/probe.h"
#include "core/effect/registry.h"

namespace {

using grisaille::Error;

// Removes the path that the registry puts first: the host's registry adds its own path.
std::string answerOf(const Error& error, const std::string& path) {
  std::string detail = error.detail();
  if (detail.starts_with(path + ": ")) detail.erase(0, path.size() + 2);
  return fmt::format("{} {}", static_cast<int>(error.id()), grisaille::oneLine(detail));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);  // a crash here is expected: write no core dump
  try {
    grisaille::effect::Registry().load(argv[1]);
  } catch (const Error& error) {
    const std::string answer = answerOf(error, argv[1]);
    const ssize_t written = write(grisaille::effect::kProbeAnswer, answer.data(), answer.size());
    const bool whole = written == static_cast<ssize_t>(answer.size());
    _exit(whole ? grisaille::effect::kProbeRefused : 1);
  }
  _exit(grisaille::effect::kProbeAccepted);  // skips the plugin's exit handlers
}
