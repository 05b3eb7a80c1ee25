// SPDX-License-Identifier: MIT
// Measures how long a file of shots takes from the disk to the first paint in a picture.
#pragma once

#include <span>
#include <string>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

// Prints a row for each count of shots, in Markdown, for pictures of the given size in pixels.
void printLoad(const std::string& backend, const Subject& subject, const effect::Registry& registry,
               tests::TracedRays& rays, std::span<const lab::Shot> shots,
               std::span<const size_t> counts, uint32_t width, uint32_t height);

}  // namespace grisaille::bench
