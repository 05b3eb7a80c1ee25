// SPDX-License-Identifier: MIT
// Finds the first triangle on each of many rays, in 32 bits. Neighbouring rays that run close
// together are traced as a packet, which costs a fraction of tracing each alone.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/trace/embree.h"

namespace grisaille::trace {

// A 32-bit ray.
struct ThinRay {
  glm::vec3 from = glm::vec3(0);
  glm::vec3 direction = glm::vec3(0);  // unit
  float length = 0;                    // metres
};

// The triangle that a ray meets. Ordered by distance, then by triangle. The default, no triangle,
// comes after all others.
struct Met {
  float distance = INFINITY;  // metres; infinite: nothing within the ray's length
  uint32_t geometry = RTC_INVALID_GEOMETRY_ID;
  uint32_t primitive = RTC_INVALID_GEOMETRY_ID;
  float u = 0, v = 0;  // Embree's barycentric weights of the second and the third corner
};

// A result depends only on its ray, bit for bit, and not on neighbouring rays.
class NearestTriangles {
 public:
  // margin: largest error of 32-bit distances, metres
  // spread: largest distance between the origins of rays in one packet, metres
  // The Embree scene must outlive this object.
  NearestTriangles(RTCScene world, float margin, float spread)
      : world_(world), margin_(margin), spread_(spread) {}

  // Writes one result per ray to `met`, which is as long as `rays`. Within a few 32-bit digits of a
  // triangle's border, findAll() may report a triangle that find() misses; find() is then right.
  void findAll(std::span<const ThinRay> rays, std::span<Met> met) const;
  Met find(const ThinRay& ray) const { return find(ray, false); }
  // The same, but the ray passes through the backs of single-sided materials. The Embree scene is
  // that of a TracedScene.
  Met findDrawn(const ThinRay& ray) const { return find(ray, true); }

 private:
  Met find(const ThinRay& ray, bool drawnOnly) const;

  RTCScene world_;
  float margin_;
  float spread_;
};

}  // namespace grisaille::trace
