// SPDX-License-Identifier: MIT
// Measures by how much frames take longer while somebody sprays paint.
#pragma once

#include <span>
#include <string>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

// Prints a row for each number of new shots a frame, in Markdown. shots: the last ones are sprayed,
// the others are in their places before.
void printSpray(const std::string& backend, const Subject& subject,
                const effect::Registry& registry, tests::TracedRays& rays,
                std::span<const lab::Shot> shots);

}  // namespace grisaille::bench
