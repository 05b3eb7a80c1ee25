// SPDX-License-Identifier: MIT
#include "tests/bench/command.h"

#include <fmt/format.h>

namespace grisaille::bench {

int runCommand(CLI::App& program, CommonOptions& options, int argc, char** argv,
               const std::function<void()>& run) {
  program.add_option("--rounds", options.rounds, "How often each row is timed")
      ->check(CLI::Range(1u, 1000u));
  program.add_option("--backend", options.backend, "opengl or vulkan; default: both");
  program.add_option("--width", options.width, "Pixels")->check(CLI::Range(16u, 16384u));
  program.add_option("--height", options.height, "Pixels")->check(CLI::Range(16u, 16384u));
  CLI11_PARSE(program, argc, argv);
  try {
    run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace grisaille::bench
