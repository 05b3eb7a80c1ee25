// SPDX-License-Identifier: MIT
// What the limit of memory costs: how many shots get coarser or go, and how far coarse paint is
// from exact paint.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

// Prints a table with a row for each limit. The shots come 200 at a time, as in a match.
// limits: values of the parameter memory, MB.
void printLimits(const std::string& backend, const Subject& subject,
                 const effect::Registry& registry, tests::TracedRays& rays,
                 std::span<const lab::Shot> shots, const std::vector<uint32_t>& limits,
                 uint32_t width, uint32_t height);

}  // namespace grisaille::bench
