// SPDX-License-Identifier: MIT
// Runs a program with subcommands: parses the command line, prints errors, returns the exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace grisaille::app {

struct ProgramDesc {
  std::string name, description, version;
  void (*addCommands)(CLI::App& program) = nullptr;
};

// Parses the command line and runs the subcommand that it names. Prints every error to standard
// error. Returns the exit status: 0 for success, 1 for an error, 2 for a mistake on the command
// line, truth::Interrupted::kStatus after an interruption.
int runProgram(int argc, char** argv, const ProgramDesc& desc);

}  // namespace grisaille::app
