// SPDX-License-Identifier: MIT
// Compares the two ways to tell what muzzles see: rays, and depth pictures that the renderer draws.
#pragma once

#include <span>
#include <string>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

// Prints what each way costs a shot, in Markdown.
void printMuzzles(const std::string& backend, const Subject& subject,
                  const effect::Registry& registry, tests::TracedRays& rays,
                  std::span<const lab::Shot> shots);

}  // namespace grisaille::bench
