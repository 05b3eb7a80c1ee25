// SPDX-License-Identifier: MIT
// Projects world positions to the pixels of a picture, in double precision.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/view.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::trace {

// View space here: x right, y down, z along the view direction. z is view depth, metres.
class Projection {
 public:
  Projection(const scene::Camera& camera, uint32_t width, uint32_t height)
      : view_(scene::viewOf(camera, {width, height})),
        viewFromWorld_(glm::transpose(view_.worldFromView)),
        centre_(-view_.offset / view_.scale),
        scale_(-1 / view_.scale.y) {}

  glm::dvec3 turn(const glm::dvec3& direction) const {
    const glm::dvec3 v = viewFromWorld_ * direction;
    return {v.x, -v.y, -v.z};
  }
  glm::dvec3 place(const glm::dvec3& position) const { return turn(position - view_.eye); }

  // Projects a view-space point with z above 0 to pixels from the top left corner.
  glm::dvec2 draw(const glm::dvec3& p) const {
    return centre_ + scale_ / scene::depthScale(view_, p.z) * glm::dvec2(p);
  }

  bool orthographic() const { return view_.orthographic; }
  const glm::dvec2& centre() const { return centre_; }  // where the view axis meets the picture
  // Pixels per metre; perspective: at a view depth of 1 m.
  double scale() const { return scale_; }
  double scaleAt(double viewDepth) const {  // pixels per metre
    return scale_ / scene::depthScale(view_, viewDepth);
  }

 private:
  scene::View view_;
  glm::dmat3 viewFromWorld_;
  glm::dvec2 centre_;
  double scale_;
};

// The plane of the facet that a pixel sees, in its view space.
struct FacetPlane {
  glm::dvec3 normal = glm::dvec3(0);
  double offset = 0;  // dot(normal, point of the plane): below 0, as it faces the eye; 0: sky

  FacetPlane() = default;
  FacetPlane(const Hit& hit, const Projection& projection)
      : normal(projection.turn(hit.facetNormal)),
        offset(hit.viewDepth > 0 ? glm::dot(normal, projection.place(hit.position)) : 0) {}

  // Metres in front of the plane; below 0: behind it.
  double height(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

}  // namespace grisaille::trace
