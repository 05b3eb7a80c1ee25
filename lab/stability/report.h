// SPDX-License-Identifier: MIT
// Writes the sweep's tables: stability.md for people, stability.csv and stability.json for
// programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lab/stability/movement.h"
#include "lab/stability/result.h"

namespace grisaille::lab::stability {

struct Sweep {
  std::string command, machine, commit;
  std::vector<std::string> devices;  // one per backend: name and driver
  std::vector<Case> cases;
  std::vector<Result> results;  // one per case
  std::vector<MovementRow> movements;

  // Number of cases and of planes under a moving camera.
  size_t count() const { return cases.size() + movements.size(); }
  // Number of these with a fault.
  size_t failed() const;
};

// Writes all three files into a folder; creates the folder if needed. Throws kFileUnwritable.
void writeSweep(const std::string& folder, const Sweep& sweep);

}  // namespace grisaille::lab::stability
