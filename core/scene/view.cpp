// SPDX-License-Identifier: MIT
#include "core/scene/view.h"

#include <cmath>

namespace grisaille::scene {

View viewOf(const Camera& camera, const glm::uvec2& size) {
  View view;
  view.eye = camera.eye;
  view.worldFromView = worldFromView(camera);
  view.size = size;
  view.orthographic = camera.orthographicHeight > 0;
  view.nearPlane = camera.nearPlane;
  view.farPlane = view.orthographic ? camera.farPlane : 0;
  const double tall = view.orthographic ? camera.orthographicHeight
                                        : 2 * std::tan(glm::radians(camera.fovyDegrees) / 2);
  const glm::dvec2 extent(tall * size.x / size.y, tall);
  view.scale = glm::dvec2(1, -1) * extent / glm::dvec2(size);
  view.offset = extent * (camera.shift + glm::dvec2(-0.5, 0.5));
  return view;
}

View widened(const View& view, uint32_t guard) {
  View wide = view;
  wide.size += 2 * guard;
  wide.offset -= double{1} * guard * view.scale;
  return wide;
}

glm::dmat4 thenFromView(const View& then, const View& now) {
  const glm::dmat3 turn = glm::transpose(then.worldFromView);
  glm::dmat4 matrix(turn * now.worldFromView);
  matrix[3] = glm::dvec4(turn * (now.eye - then.eye), 1);
  return matrix;
}

glm::dvec3 viewPosition(const View& view, const glm::dvec2& pixel, double viewDepth) {
  return {(pixel * view.scale + view.offset) * depthScale(view, viewDepth), -viewDepth};
}

glm::dvec3 worldPosition(const View& view, const glm::dvec2& pixel, double viewDepth) {
  return view.eye + view.worldFromView * viewPosition(view, pixel, viewDepth);
}

ViewRay rayAt(const View& view, const glm::dvec2& pixel) {
  const glm::dvec2 place = pixel * view.scale + view.offset;
  if (view.orthographic) {
    return {view.eye + view.worldFromView * glm::dvec3(place, 0), -view.worldFromView[2]};
  }
  return {view.eye, view.worldFromView * glm::dvec3(place, -1)};
}

glm::dvec2 pixelOf(const View& view, const glm::dvec3& position) {
  return (glm::dvec2(position) / depthScale(view, -position.z) - view.offset) / view.scale;
}

glm::dmat4 clipFromView(const View& view) {
  // Clip x from -1 to 1 is pixel 0 to the width; clip y runs the other way.
  const glm::dvec2 half = glm::dvec2(0.5, -0.5) * view.scale * glm::dvec2(view.size);
  const glm::dvec2 centre = view.offset + glm::dvec2(1, -1) * half;
  glm::dmat4 clip(0);
  clip[0][0] = 1 / half.x;
  clip[1][1] = 1 / half.y;
  if (view.orthographic) {
    const double range = view.farPlane - view.nearPlane;
    clip[2][2] = 1 / range;
    clip[3] = glm::dvec4(-centre / half, view.farPlane / range, 1);
  } else {
    clip[2] = glm::dvec4(centre / half, 0, -1);
    clip[3][2] = view.nearPlane;
  }
  return clip;
}

double viewDepthOf(const View& view, double clipDepth) {
  if (!view.orthographic) return view.nearPlane / clipDepth;
  return view.farPlane - clipDepth * (view.farPlane - view.nearPlane);
}

double clipDepthOf(const View& view, double viewDepth) {
  if (!view.orthographic) return view.nearPlane / viewDepth;
  return (view.farPlane - viewDepth) / (view.farPlane - view.nearPlane);
}

}  // namespace grisaille::scene
