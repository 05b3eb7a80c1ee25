// SPDX-License-Identifier: MIT
#include "core/frame/view_block.h"

#include <cmath>
#include <cstddef>
#include <cstring>

#include "shaders/view_depth.h"

namespace grisaille::frame {
namespace {

GRISAILLE_CHECK_BLOCK_view_depth_View(ViewBlock);

// Half the picture's height and width at 1 m view depth, metres.
glm::dvec2 halfExtent(const scene::Camera& camera, uint32_t width, uint32_t height) {
  const double y = std::tan(glm::radians(camera.fovyDegrees) / 2);
  return {y * width / height, y};
}

}  // namespace

ViewBlock viewBlock(const scene::Camera& camera, uint32_t width, uint32_t height, uint32_t guard) {
  const glm::dvec2 half = halfExtent(camera, width, height);
  const glm::dvec2 size(width, height);
  // x = -half + pixel * 2 half / size; y is negated, because row 0 is the top.
  const glm::dvec2 scale(2 * half.x / size.x, -2 * half.y / size.y);
  const glm::dvec2 offset(-half.x, half.y);
  const glm::dvec3 cell = glm::floor(camera.eye);
  ViewBlock block{};
  block.view_from_pixel = glm::vec4(glm::dvec4(scale, offset));
  block.pixel_from_view = glm::vec4(glm::dvec4(1.0 / scale, -offset / scale));
  block.size = glm::vec4(glm::dvec4(size, 1.0 / size));
  block.view_from_world = glm::mat4(glm::dmat4(glm::transpose(scene::worldFromView(camera))));
  // Cells are equal modulo 2^32, so that cameras beyond 2^31 m have one too.
  block.camera_cell = glm::ivec4(glm::ivec3(glm::uvec3(glm::i64vec3(cell))), 0);
  block.camera_fraction = glm::vec4(glm::dvec4(camera.eye - cell, camera.nearPlane));
  const glm::dvec2 band(guard);
  block.attachment = glm::vec4(glm::dvec4(band, 1.0 / (size + 2.0 * band)));
  return block;
}

scene::Camera widened(const scene::Camera& camera, uint32_t height, uint32_t guard) {
  scene::Camera wide = camera;
  const double share = (height + 2.0 * guard) / height;
  if (guard > 0) {
    wide.fovyDegrees =
        glm::degrees(2 * std::atan(std::tan(glm::radians(camera.fovyDegrees) / 2) * share));
  }
  return wide;
}

grisaille_view viewOf(const scene::Camera& camera, uint32_t width, uint32_t height) {
  grisaille_view view{};
  view.struct_size = sizeof(view);
  const glm::dmat3 axes = scene::worldFromView(camera);
  const glm::dmat4 clip = scene::clipFromView(camera, double{1} * width / height);
  std::memcpy(view.position, &camera.eye, sizeof(view.position));
  std::memcpy(view.world_from_view, &axes, sizeof(view.world_from_view));
  std::memcpy(view.clip_from_view, &clip, sizeof(view.clip_from_view));
  view.near_plane = camera.nearPlane;
  view.pixel_slope = 2 * halfExtent(camera, width, height).y / height;
  return view;
}

}  // namespace grisaille::frame
