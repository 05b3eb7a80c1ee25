// SPDX-License-Identifier: MIT
// A camera with its picture: which position a pixel shows at a view depth. The frame, the effects,
// the ray tracer, the oracles and hosts of libgrisaille all use this description.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"

namespace grisaille::scene {

// View space has x to the right, y up, and the camera looks along -z. View depth is -z. The pixel
// (0, 0) is the picture's top left corner, and (0.5, 0.5) the centre of the first pixel.
struct View {
  glm::dvec3 eye = glm::dvec3(0);            // world, metres
  glm::dmat3 worldFromView = glm::dmat3(1);  // columns: right, up, backward
  glm::uvec2 size = glm::uvec2(1);           // pixels
  // view.xy = (pixel * scale + offset) * (orthographic ? 1 : view depth)
  glm::dvec2 scale = glm::dvec2(1, -1), offset = glm::dvec2(0);
  double nearPlane = 0.01;  // metres
  double farPlane = 0;      // metres; orthographic: above nearPlane; perspective: 0, infinite
  bool orthographic = false;
  // Pixels, x to the right, y down: by how much `offset` shifts the picture for temporal
  // antialiasing.
  glm::dvec2 jitter = glm::dvec2(0);

  bool operator==(const View&) const = default;
};

// A ray in the world. Its direction has a view depth of 1: a distance along it is a view depth.
struct ViewRay {
  glm::dvec3 origin;  // view depth 0
  glm::dvec3 direction;
};

View viewOf(const Camera& camera, const glm::uvec2& size);

// The view whose picture extends `guard` pixels further on each side.
View widened(const View& view, uint32_t guard);

// From the view space of `now` to that of `then`. In double precision: the cameras may be far from
// the world's origin.
glm::dmat4 thenFromView(const View& then, const View& now);

// Metres that a pixel spans, per metre of `scale`: the view depth, or 1 if orthographic.
inline double depthScale(const View& view, double viewDepth) {
  return view.orthographic ? 1.0 : viewDepth;
}

// Position in view space of the surface that a pixel shows.
glm::dvec3 viewPosition(const View& view, const glm::dvec2& pixel, double viewDepth);
// The same in the world.
glm::dvec3 worldPosition(const View& view, const glm::dvec2& pixel, double viewDepth);
ViewRay rayAt(const View& view, const glm::dvec2& pixel);

// Pixel of a position in view space. Perspective: the position lies in front of the camera.
glm::dvec2 pixelOf(const View& view, const glm::dvec3& position);

// Height of a pixel at a view depth, metres.
inline double pixelSize(const View& view, double viewDepth) {
  return -view.scale.y * depthScale(view, viewDepth);
}

// Projection to clip space with y up and reversed depth: clip depth is 1 at the near plane.
// Perspective: near plane / view depth. Orthographic: linear, 0 at the far plane.
glm::dmat4 clipFromView(const View& view);

// View depth of a clip depth above 0, and the inverse.
double viewDepthOf(const View& view, double clipDepth);
double clipDepthOf(const View& view, double viewDepth);

}  // namespace grisaille::scene
