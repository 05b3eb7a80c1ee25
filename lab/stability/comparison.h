// SPDX-License-Identifier: MIT
// Compares a picture of an effect with its oracle.
#pragma once

#include <span>
#include <vector>

#include "core/effect/values.h"
#include "core/image/image.h"
#include "lab/oracle/view.h"
#include "lab/stability/result.h"

namespace grisaille::lab::stability {

// The largest difference over the channels of each pixel; 1 if a value is not finite. Both pictures
// have the same size.
std::vector<float> differences(const image::Image& a, const image::Image& b);

// The pixels to compare with an oracle: all, or tiles spread over a large picture.
std::vector<glm::ivec2> pixelsToCompare(const glm::ivec2& size);

// Sets result.oracle and, if the case has these limits, leastOpen and cornerError. Returns the
// oracle's picture. `views`: the effect's inputs of the earlier frames, then of the case itself.
// `picture`: the effect's output.
image::Image compareOcclusion(const Case& one, const effect::Values& values,
                              std::span<const oracle::View> views, const image::Image& picture,
                              BackendResult& result);

// Sets result.oracle, and returns the oracle's paint. In the mode `surface`, the view's normals are
// facet normals.
image::Image comparePaint(const Case& one, const effect::Values& values, const oracle::View& view,
                          const scene::Scene& scene, const image::Image& paint,
                          const image::Image& coverage, BackendResult& result);

// The exact visibility beside the edge of a right-angled corner, `radii` radii from the edge. A
// direction is blocked if it meets the other wall within the radius. Projected to the unit disc
// (Nusselt's analogue), the blocked directions of the cosine-weighted hemisphere form a segment.
double cornerVisibility(double radii);

}  // namespace grisaille::lab::stability
