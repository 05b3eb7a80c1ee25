// SPDX-License-Identifier: MIT
// What the edges look like: of each the case that differs most.
#pragma once

#include <optional>
#include <string>

#include "lab/stability/report.h"
#include "lab/stability/runner.h"

namespace grisaille::lab::stability {

// The index of the edge's case with the largest share of pixels off the oracle, on the first
// backend, of those whose picture has 32 to 200 pixels a side; none: no such case is off.
std::optional<size_t> worstOf(const Sweep& sweep, const std::string& edge);

// pictures/stability/<key>.png, with what may stand in no file name as a hyphen.
std::string edgePictureName(const std::string& edge);

// Into a folder by that name, for every edge of the sweep: what the effect made, the same in double
// precision, and black where they are over kTolerance apart. Throws kFileUnwritable.
void writeEdgePictures(const std::string& folder, Runner& runner, const Sweep& sweep);

}  // namespace grisaille::lab::stability
