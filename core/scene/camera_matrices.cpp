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

// An axis of the picture, from two rows of the projection: `axis`, the row of the axis, and
// `depth`, the row of w.
struct Axis {
  glm::dvec3 direction;  // unit, world: the direction in which the coordinate grows
  double centre = 0;     // coordinate of the optical axis
  double slope = 0;      // growth of the coordinate per metre, at a view depth of 1
};
Axis axisOf(const glm::dvec3& axis, const glm::dvec3& depth) {
  const double centre = glm::dot(axis, depth) / glm::dot(depth, depth);
  const glm::dvec3 across = axis - centre * depth;
  return {glm::normalize(across), centre, glm::length(across) / glm::length(depth)};
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
  const glm::dvec3 depth = rowOf(ndc, 3);  // grows along the view direction
  if (!(glm::length(depth) > 1e-9)) refuse(name, "worldToNDC is not a perspective projection");
  const glm::dvec3 forward = glm::normalize(depth);
  if (!(std::abs(glm::dot(forward, glm::normalize(rowOf(view, 2)))) >= 0.9999)) {
    refuse(name, "worldToCamera and worldToNDC look in different directions");
  }
  const Axis x = axisOf(rowOf(ndc, 0), depth), y = axisOf(rowOf(ndc, 1), depth);
  // The centre tells whether NDC runs from 0 to 1 or from -1 to 1.
  const bool fromZero = std::abs(x.centre - 0.5) < 0.25 && std::abs(y.centre - 0.5) < 0.25;
  const double centre = fromZero ? 0.5 : 0, half = fromZero ? 0.5 : 1;
  constexpr double kOff = 1e-3;  // half a pixel of a picture of 1000 pixels
  if (!(std::abs(x.centre - centre) <= kOff * half && std::abs(y.centre - centre) <= kOff * half)) {
    refuse(name, "the view axis passes through ({:.4f}, {:.4f}) of NDC, not through the centre",
           x.centre, y.centre);
  }
  if (!(glm::dot(x.direction, glm::cross(forward, up)) >= 0.999)) {
    refuse(name, "the picture is mirrored or sheared");
  }
  const double tangent = half / y.slope, across = half / x.slope;
  const double aspect = double{1} * width / height;
  if (!(std::abs(across / tangent / aspect - 1) <= 0.01)) {
    refuse(name, "the matrices have an aspect ratio of {:.3f} : 1, but the picture has {:.3f} : 1",
           across / tangent, aspect);
  }
  Camera camera;
  camera.eye = -(glm::inverse(rotation) * glm::dvec3(view[3]));
  camera.target = camera.eye + forward;
  camera.up = up;
  camera.fovyDegrees = glm::degrees(2 * std::atan(tangent));
  try {
    validate(camera);
  } catch (const Error& error) {
    refuse(name, "{}", error.detail());
  }
  return camera;
}

}  // namespace grisaille::scene
