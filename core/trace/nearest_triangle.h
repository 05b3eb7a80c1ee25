// SPDX-License-Identifier: MIT
// Which triangle each of many rays meets first, in 32 bits. Rays that run beside their neighbours
// are traced together, which costs a fraction of tracing each alone.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/trace/embree.h"

namespace grisaille::trace {

struct ThinRay {
  glm::vec3 from = glm::vec3(0);
  glm::vec3 direction = glm::vec3(0);  // unit
  float length = 0;                    // metres
};

// Ordered first by distance, then by triangle. The default is beyond all others.
struct Met {
  float distance = INFINITY;  // metres; infinite: nothing within the ray's length
  uint32_t geometry = RTC_INVALID_GEOMETRY_ID;
  uint32_t primitive = RTC_INVALID_GEOMETRY_ID;
  float u = 0, v = 0;  // Embree's: shares of the second and the third corner
};

// Finds what depends on the ray alone, to the bit, and not on those beside it.
class NearestTriangles {
 public:
  // `margin`: metres that 32-bit distances are off at most. `spread`: metres that starting points
  // of rays traced together may lie apart.
  NearestTriangles(RTCScene world, float margin, float spread)
      : world_(world), margin_(margin), spread_(spread) {}

  // One outcome an element of `met`, which is as long as `rays`. But what passes by a triangle's
  // border within some 32-bit digits may be met here and not by find(): there, find() tells.
  void findAll(std::span<const ThinRay> rays, std::span<Met> met) const;
  Met find(const ThinRay& ray) const;

 private:
  RTCScene world_;
  float margin_;
  float spread_;
};

}  // namespace grisaille::trace
