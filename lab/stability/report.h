// SPDX-License-Identifier: MIT
// The sweep's table: stability.md for people, stability.csv and stability.json for programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lab/stability/movement.h"
#include "lab/stability/result.h"

namespace grisaille::lab::stability {

struct Sweep {
  std::string command, machine, commit;
  std::vector<std::string> devices;  // one a backend: name and driver
  std::vector<Case> cases;
  std::vector<Result> results;  // one a case
  std::vector<MovementRow> movements;

  // Cases, and planes under a moving camera.
  size_t count() const { return cases.size() + movements.size(); }
  // Those with a fault.
  size_t failed() const;
};

// Writes all three into a folder, which is made where it is not there. Throws kFileUnwritable.
void writeSweep(const std::string& folder, const Sweep& sweep);

}  // namespace grisaille::lab::stability
