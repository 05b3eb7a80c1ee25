// SPDX-License-Identifier: MIT
// A picture of an effect against its oracle.
#pragma once

#include <span>
#include <vector>

#include "core/effect/values.h"
#include "core/image/image.h"
#include "lab/oracle/view.h"
#include "lab/stability/result.h"

namespace grisaille::lab::stability {

// The largest difference of each pixel's channels; 1 where a value is not finite. Of one size.
std::vector<float> differences(const image::Image& a, const image::Image& b);

// The pixels that are compared with an oracle: all, or those of tiles spread over a large picture.
std::vector<glm::ivec2> pixelsToCompare(const glm::ivec2& size);

// Sets result.oracle and, where the case knows more, leastOpen and cornerError. `views` are what
// the effect read, of the frames before as well, and the case's own last; `picture` is what it made
// of that.
image::Image compareOcclusion(const Case& one, const effect::Values& values,
                              std::span<const oracle::View> views, const image::Image& picture,
                              BackendResult& result);

// Sets result.oracle, and returns the oracle's paint. In the mode `surface` the view's normals are
// those of the facets.
image::Image comparePaint(const Case& one, const effect::Values& values, const oracle::View& view,
                          const scene::Scene& scene, const image::Image& paint,
                          const image::Image& coverage, BackendResult& result);

// What rays would find beside a right-angled corner, at a distance from its edge in radii: of the
// cosine-weighted hemisphere the part is blocked whose directions come nearer to the other wall
// than this within a radius. Seen from above that is a segment of the unit disc (Nusselt's
// analogue).
double cornerVisibility(double radii);

}  // namespace grisaille::lab::stability
