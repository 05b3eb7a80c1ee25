// SPDX-License-Identifier: MIT
// Replaces view.cpp in a build without the viewer.
#include "app/command.h"
#include "core/base/error.h"

namespace grisaille::app {

void addView(CLI::App& program) {
  CLI::App* command = program.add_subcommand("view", "Not in this build: GRISAILLE_VIEWER is off");
  command->allow_extras();
  command->callback(
      [] { throw Error(ErrorId::kLeftOut, "this build has no viewer: GRISAILLE_VIEWER is off"); });
}

}  // namespace grisaille::app
