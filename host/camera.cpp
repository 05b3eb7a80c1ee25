// SPDX-License-Identifier: MIT
#include "host/camera.h"

#include <algorithm>
#include <cmath>

#include "host/checks.h"

namespace grisaille::host {
namespace {

// Renderers write more than this for the sky, and less for a scene. Same as in `grisaille apply`.
constexpr double kSky = 1e9;  // metres

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorId::kHostCamera, "{}", why);
}

glm::dmat3 rotationOf(const grisaille_host_camera& camera) {
  glm::dmat3 axes;
  for (int i = 0; i < 9; ++i) axes[i / 3][i % 3] = camera.world_from_view[i];
  const glm::dmat3 product = glm::transpose(axes) * axes;
  for (int i = 0; i < 9; ++i) {
    if (!(std::abs(product[i / 3][i % 3] - (i % 4 == 0 ? 1 : 0)) <= 1e-3)) {
      refuse("the columns of world_from_view are not perpendicular axes of length 1");
    }
  }
  if (glm::determinant(axes) < 0) refuse("world_from_view is a reflection");
  return axes;
}

double farOf(const grisaille_host_camera& camera) {
  return camera.far_plane == 0 ? std::numeric_limits<double>::infinity() : camera.far_plane;
}

void check(const grisaille_host_camera& camera, bool orthographic) {
  checkReserved(camera.reserved, "camera.reserved");
  for (const double x : camera.position) {
    if (!(std::abs(x) <= 1e15)) refuse(fmt::format("position holds {}, not within 1e15", x));
  }
  if (!(camera.near_plane > 0 && camera.near_plane <= 1e6)) {
    refuse(fmt::format("near_plane is {}, not over 0 and at most 1e6", camera.near_plane));
  }
  const double far = farOf(camera);
  if (!(far > camera.near_plane)) {
    refuse(fmt::format("far_plane is {}, not over near_plane {}", far, camera.near_plane));
  }
  if (orthographic) {
    const double height = camera.orthographic_height;
    if (!(height > 0 && height <= 1e9)) {
      refuse(fmt::format(
          "vertical_angle is 0, and orthographic_height is {}, not over 0 and at most 1e9",
          height));
    }
    if (!(far <= kSky)) refuse("an orthographic camera needs a far_plane of at most 1e9");
  } else {
    if (!(camera.vertical_angle >= 0.01 && camera.vertical_angle <= 3.1)) {
      refuse(fmt::format("vertical_angle is {} radians, neither 0 nor from 0.01 to 3.1",
                         camera.vertical_angle));
    }
    if (camera.orthographic_height != 0) {
      refuse("vertical_angle and orthographic_height are both given");
    }
  }
}

}  // namespace

View viewOf(const grisaille_host_frame& frame, uint32_t width, uint32_t height, uint32_t rows) {
  const grisaille_host_camera& camera = whole(frame.camera, "frame.camera");
  checkEnum(frame.depth_kind, 4, "frame.depth_kind");
  checkEnum(frame.normal_space, 2, "frame.normal_space");
  checkEnum(frame.normal_encoding, 2, "frame.normal_encoding");
  const bool orthographic = camera.vertical_angle == 0;
  check(camera, orthographic);
  const glm::dmat3 axes = rotationOf(camera);
  const double near = camera.near_plane, far = farOf(camera);
  const double aspect = double{1} * width / height;

  View view{};
  view.camera.eye = {camera.position[0], camera.position[1], camera.position[2]};
  view.camera.target = view.camera.eye - axes[2] * std::max(1.0, glm::length(view.camera.eye));
  view.camera.up = axes[1];
  view.camera.fovyDegrees = glm::degrees(camera.vertical_angle);
  view.camera.nearPlane = near;
  double half = std::tan(camera.vertical_angle / 2);  // half the height, at a view depth of 1
  if (orthographic) {
    const double seen = camera.orthographic_height;
    view.camera = scene::orthographicCamera(view.camera, seen, seen * aspect, far);
    half = seen / 2;
  }

  SourceBlock& source = view.source;
  source.world_from_view = glm::mat4(glm::mat3(axes));
  const glm::dvec2 corner(half * aspect, half);
  source.view_from_pixel =
      glm::vec4(glm::dvec4(2 * corner.x / width, -2 * corner.y / height, -corner.x, corner.y));
  source.planes = glm::vec4(
      glm::dvec4(near, std::min(far, kSky), std::isinf(far) ? 0 : near / far, std::min(far, kSky)));
  source.shift = glm::vec4(glm::dvec4(view.camera.nearPlane - near, view.camera.nearPlane, 0, 0));
  source.mode = glm::ivec4(frame.depth_kind, orthographic ? 1 : 0,
                           rows == GRISAILLE_HOST_ROWS_FROM_BOTTOM ? 1 : 0,
                           frame.normal_encoding | frame.normal_space << 1);
  return view;
}

}  // namespace grisaille::host
