// SPDX-License-Identifier: MIT
// grisaille: screen-space effects with a measured error. See README.md.
#include "app/command.h"
#include "app/options/option_checks.h"
#include "app/process/program.h"

namespace {

void addCommands(CLI::App& program) {
  grisaille::app::addRender(program);
  grisaille::app::addApply(program);
  grisaille::app::addView(program);
  grisaille::app::addEffects(program);
  grisaille::app::addNewEffect(program);
  grisaille::app::addBackends(program);
  grisaille::app::addTruth(program);
  grisaille::app::addMeasure(program);
  grisaille::app::addTune(program);
  grisaille::app::addScene(program);
  grisaille::app::addCompletion(program);
  for (CLI::App* command : program.get_subcommands({})) {
    grisaille::app::refuseEmptyValues(*command);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return grisaille::app::runProgram(argc, argv,
                                    {.name = "grisaille",
                                     .description = "Screen-space effects with a measured error",
                                     .version = GRISAILLE_VERSION,
                                     .addCommands = addCommands});
}
