// SPDX-License-Identifier: MIT
// Pictures of the edges in edges(): the case with the largest difference for each.
#pragma once

#include <optional>
#include <string>

#include "lab/stability/report.h"
#include "lab/stability/runner.h"

namespace grisaille::lab::stability {

// The index of the edge's case with the largest share of pixels off the oracle on the first
// backend, among pictures of 32 to 200 pixels per side. None if no such case differs.
std::optional<size_t> worstOf(const Sweep& sweep, const std::string& edge);

// pictures/stability/<key>.png, without apostrophes. Other characters than letters and digits
// become hyphens.
std::string edgePictureName(const std::string& edge);

// Writes one picture per edge of the sweep into `folder`, by these names: the effect's output, the
// oracle's, and black where they differ by over kTolerance. Throws kFileUnwritable.
void writeEdgePictures(const std::string& folder, Runner& runner, const Sweep& sweep);

}  // namespace grisaille::lab::stability
