// SPDX-License-Identifier: MIT
// The passes that draw the scene, and how much of their time counts as a cost of the effects.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/effect/selection.h"

namespace grisaille::frame {

// Label prefixes of the passes that draw the scene: at the picture's size, or with a guard band.
constexpr std::string_view kScenePasses = "scene/", kGuardedPasses = "scene/guarded ";

// The share of the time of a pass with a guard band that is spent beyond the picture, estimated
// from the area. 0 if no effect has a guard band.
double guardShare(const effect::Selection& selection, uint32_t width, uint32_t height);
// The share of a pass's time to count as a cost of the effects, although the pass draws the scene:
// the whole pass for back faces, the added area for guard bands. Most renderers need neither.
double shareForEffects(std::string_view pass, double guardShare);

}  // namespace grisaille::frame
