// SPDX-License-Identifier: MIT
// The command line that all benchmarks share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace grisaille::bench {

struct CommonOptions {
  uint32_t rounds = 7;  // number of timings per row
  std::string backend;  // empty: both
  uint32_t width = 1280, height = 720;
};

// Adds the common options, reads the command line, and runs. Returns the exit status.
int runCommand(CLI::App& program, CommonOptions& options, int argc, char** argv,
               const std::function<void()>& run);

}  // namespace grisaille::bench
