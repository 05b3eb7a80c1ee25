// SPDX-License-Identifier: MIT
// In place of view.cpp where a build has no viewer.
#include "app/command.h"
#include "core/base/error.h"

namespace grisaille::app {

void addView(CLI::App& program) {
  CLI::App* command = program.add_subcommand("view", "Not in this build: GRISAILLE_VIEWER was off");
  command->allow_extras();
  command->callback(
      [] { throw Error(ErrorId::kLeftOut, "this build has no viewer: GRISAILLE_VIEWER was off"); });
}

}  // namespace grisaille::app
