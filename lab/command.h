// SPDX-License-Identifier: MIT
// The subcommands of grisaille-lab, one file each. Each function adds its subcommand; the
// subcommand's callback does the work and throws grisaille::Error.
#pragma once

#include <CLI/CLI.hpp>

namespace grisaille::lab {

void addClaims(CLI::App& program);
void addPaintMask(CLI::App& program);
void addSoak(CLI::App& program);
void addStability(CLI::App& program);

}  // namespace grisaille::lab
