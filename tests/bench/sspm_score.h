// SPDX-License-Identifier: MIT
// The score of paint over a scene's surface: its time, and its error against rays.
#pragma once

#include <cstddef>
#include <span>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

// Prints a line of Markdown for the score of these shots. The effect needs no device for it: a null
// device records the frame that places the shots.
void printScore(const Subject& subject, const effect::Registry& registry, tests::TracedRays& rays,
                std::span<const lab::Shot> shots);

}  // namespace grisaille::bench
