// SPDX-License-Identifier: MIT
// Paint at points of surfaces, computed on the host: grisaille_effect_desc::draw_at.
#pragma once

#include <span>

#include "paint_world.h"
#include "splat_noise.h"

namespace grisaille::sspm {

// Mode `surface`: the placed shots of the world whose muzzle sees the point, by a ray to it.
// shots: the list of the world's last update() or follow(). Without rays, `drawn` stays unchanged.
void drawPoints(const PaintWorld& world, std::span<const Shot> shots, const PaintRules& rules,
                const Splat& splat, const CastRays& cast, std::span<const grisaille_point> points,
                std::span<grisaille_drawn> drawn);

// Mode `per_shot`: the newest `count` shots, also behind walls.
void drawPointsPerShot(std::span<const Shot> shots, size_t count, const PaintRules& rules,
                       const Splat& splat, std::span<const grisaille_point> points,
                       std::span<grisaille_drawn> drawn);

}  // namespace grisaille::sspm
