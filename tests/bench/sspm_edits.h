// SPDX-License-Identifier: MIT
// How soon a changed parameter of paint shows.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

// Prints a table for one backend: the time from a change of paint_range, r0 and edge_fade to the
// next frame and to the frame in which no shot waits. `counts`: numbers of the first `shots`; a
// number that is too large is left out. Throws as backends::create() does.
void printEdits(const std::string& backend, const Subject& subject,
                const effect::Registry& registry, tests::TracedRays& rays,
                std::span<const lab::Shot> shots, std::span<const size_t> counts, uint32_t width,
                uint32_t height);

}  // namespace grisaille::bench
