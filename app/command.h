// SPDX-License-Identifier: MIT
// The subcommands of the program, one file each. Every function adds one subcommand. The callback
// of the subcommand does the work and throws grisaille::Error.
#pragma once

#include <CLI/CLI.hpp>

namespace grisaille::app {

void addRender(CLI::App& program);
void addApply(CLI::App& program);
void addView(CLI::App& program);
void addEffects(CLI::App& program);
void addNewEffect(CLI::App& program);
void addBackends(CLI::App& program);
void addMeasure(CLI::App& program);
void addTruth(CLI::App& program);
void addTune(CLI::App& program);
void addScene(CLI::App& program);
void addCompletion(CLI::App& program);

}  // namespace grisaille::app
