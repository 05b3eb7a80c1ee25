// SPDX-License-Identifier: MIT
// grisaille-lab: measures claims about the effects, and tests the effects at the limits of their
// parameters against double precision. See docs/manual/lab.md.
#include "app/options/option_checks.h"
#include "app/process/program.h"
#include "lab/command.h"

namespace {

void addCommands(CLI::App& program) {
  grisaille::lab::addStability(program);
  grisaille::lab::addClaims(program);
  grisaille::lab::addPaintMask(program);
  grisaille::lab::addSoak(program);
  for (CLI::App* command : program.get_subcommands({})) {
    grisaille::app::refuseEmptyValues(*command);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return grisaille::app::runProgram(
      argc, argv,
      {.name = "grisaille-lab",
       .description = "Tests of Grisaille's effects: numerical stability, and claims about them",
       .version = GRISAILLE_VERSION,
       .addCommands = addCommands});
}
