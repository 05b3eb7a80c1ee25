// SPDX-License-Identifier: MIT
#include "core/scene/camera_matrices.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/view.h"

namespace grisaille::scene {
namespace {

// OpenEXR multiplies row vectors and stores rows; glm multiplies column vectors and stores columns.
// The transposed matrix therefore has the same numbers in the same order.
glm::dmat4 fromRows(const std::array<float, 16>& rows) {
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = double{rows[static_cast<size_t>(i)]};
  return matrix;
}

std::array<float, 16> toRows(const glm::dmat4& matrix) {
  std::array<float, 16> rows;
  for (int i = 0; i < 16; ++i) {
    rows[static_cast<size_t>(i)] = static_cast<float>(matrix[i / 4][i % 4]);
  }
  return rows;
}

template <typename... Args>
[[noreturn]] void refuse(const std::string& name, fmt::format_string<Args...> why, Args&&... args) {
  throw Error(ErrorId::kPictureMatrices, "{}: {}", name,
              fmt::format(why, std::forward<Args>(args)...));
}

// The direction part of one row of a matrix for column vectors.
glm::dvec3 rowOf(const glm::dmat4& matrix, int row) {
  return {matrix[0][row], matrix[1][row], matrix[2][row]};
}

// The line of sight through the eye, as worldToNDC sees it.
struct Sight {
  glm::dvec3 forward = {};           // unit, world
  glm::dvec2 centre = {};            // NDC of the optical axis
  glm::dvec3 right = {}, down = {};  // unit, world: where NDC x and y grow
  glm::dvec2 slope = {};             // growth of NDC per metre: orthographic, or 1 m away
};

Sight perspectiveOf(const glm::dmat4& ndc, const glm::dvec3& depth) {
  Sight sight{.forward = glm::normalize(depth)};
  const auto across = [&](int row) {
    const glm::dvec3 axis = rowOf(ndc, row);
    sight.centre[row] = glm::dot(axis, depth) / glm::dot(depth, depth);
    const glm::dvec3 direction = axis - sight.centre[row] * depth;
    sight.slope[row] = glm::length(direction) / glm::length(depth);
    return glm::normalize(direction);
  };
  sight.right = across(0);
  sight.down = across(1);
  return sight;
}

// Without a perspective division, only the sense of worldToCamera says which way the camera looks:
// a right-handed camera space looks along -z, a left-handed one along z.
Sight orthographicOf(const glm::dmat4& ndc, const glm::dmat4& view, const glm::dvec3& eye) {
  const double sense = glm::determinant(glm::dmat3(view)) > 0 ? -1 : 1;
  const double w = ndc[3][3];
  Sight sight{.forward = sense * glm::normalize(rowOf(view, 2)),
              .centre = glm::dvec2(ndc * glm::dvec4(eye, 1)) / w};
  sight.right = glm::normalize(rowOf(ndc, 0) / w);
  sight.down = glm::normalize(rowOf(ndc, 1) / w);
  sight.slope = glm::dvec2(glm::length(rowOf(ndc, 0)), glm::length(rowOf(ndc, 1))) / std::abs(w);
  return sight;
}

// The NDC of the picture's centre: 0 if NDC runs from -1 to 1, 0.5 if it runs from 0 to 1. Takes
// the range in which the optical axis is closer to the centre.
double middleOf(const glm::dvec2& axis, const std::string& name) {
  constexpr double kClose = 0.1;       // of half the picture
  constexpr double kRounding = 1.001;  // the axis of a corner is as close in both; floats round it
  const double fromZero = glm::length(axis - 0.5) / 0.5;
  if (glm::length(axis) <= kRounding * fromZero) return 0;
  if (fromZero <= kClose) return 0.5;
  refuse(name,
         "the view axis passes through ({:.4f}, {:.4f}) of NDC, which does not tell whether NDC "
         "begins at 0 or at -1",
         axis.x, axis.y);
}

}  // namespace

image::ViewMatrices matricesOf(const Camera& camera, uint32_t width, uint32_t height) {
  const glm::dmat3 rotation = glm::transpose(worldFromView(camera));
  glm::dmat4 view(rotation);
  view[3] = glm::dvec4(-(rotation * camera.eye), 1);
  return {.worldToCamera = toRows(view),
          .worldToNdc = toRows(clipFromView(viewOf(camera, {width, height})) * view)};
}

Camera cameraOf(const image::ViewMatrices& matrices, uint32_t width, uint32_t height,
                const std::string& name) {
  // Every check below states the valid case, because NaN fails every comparison.
  const glm::dmat4 view = fromRows(matrices.worldToCamera), ndc = fromRows(matrices.worldToNdc);
  const glm::dmat3 rotation(view);
  const double size = std::cbrt(std::abs(glm::determinant(rotation)));
  if (!(size > 1e-6) || !std::isfinite(size)) refuse(name, "worldToCamera cannot be inverted");
  const glm::dvec3 up = glm::normalize(rowOf(view, 1));
  const glm::dvec3 eye = -(glm::inverse(rotation) * glm::dvec3(view[3]));
  const glm::dvec3 depth = rowOf(ndc, 3);  // grows along the view direction
  const bool perspective = glm::length(depth) > 1e-9;
  if (!perspective && !(std::abs(ndc[3][3]) > 1e-9)) refuse(name, "worldToNDC is no projection");
  const Sight sight = perspective ? perspectiveOf(ndc, depth) : orthographicOf(ndc, view, eye);
  if (!(std::abs(glm::dot(sight.forward, glm::normalize(rowOf(view, 2)))) >= 0.9999)) {
    refuse(name, "worldToCamera and worldToNDC look in different directions");
  }
  const double middle = middleOf(sight.centre, name), half = 1 - middle;
  // `down` may point up: renderers differ.
  const double y = glm::dot(sight.down, up);
  if (!(glm::dot(sight.right, glm::cross(sight.forward, up)) >= 0.999 && std::abs(y) >= 0.999)) {
    refuse(name, "the picture is mirrored or sheared");
  }
  const glm::dvec2 extent = 2 * half / sight.slope;  // metres: orthographic, or 1 m away
  const double aspect = double{1} * width / height;
  if (!(std::abs(extent.x / extent.y / aspect - 1) <= 0.01)) {
    refuse(name, "the matrices have an aspect ratio of {:.3f} : 1, but the picture has {:.3f} : 1",
           extent.x / extent.y, aspect);
  }
  Camera camera;
  camera.eye = eye;
  camera.target = eye + sight.forward;
  camera.up = up;
  camera.shift = (middle - sight.centre) / (2 * half) * glm::dvec2(1, y > 0 ? 1 : -1);
  if (perspective) {
    camera.fovyDegrees = glm::degrees(2 * std::atan(extent.y / 2));
  } else {
    camera.orthographicHeight = extent.y;
  }
  try {
    validate(camera);
  } catch (const Error& error) {
    refuse(name, "{}", error.detail());
  }
  return camera;
}

}  // namespace grisaille::scene
