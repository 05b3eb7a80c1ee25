// SPDX-License-Identifier: MIT
#include "core/frame/view_block.h"

#include <cstddef>
#include <cstring>

#include "shaders/view_depth.h"

namespace grisaille::frame {
namespace {

GRISAILLE_CHECK_BLOCK_view_depth_View(ViewBlock);

}  // namespace

ViewBlock viewBlock(const scene::View& view, uint32_t guard) {
  const glm::dvec2 size(view.size);
  const glm::dvec3 cell = glm::floor(view.eye);
  ViewBlock block{};
  block.view_from_pixel = glm::vec4(glm::dvec4(view.scale, view.offset));
  block.pixel_from_view = glm::vec4(glm::dvec4(1.0 / view.scale, -view.offset / view.scale));
  block.size = glm::vec4(glm::dvec4(size, 1.0 / size));
  block.view_from_world = glm::mat4(glm::dmat4(glm::transpose(view.worldFromView)));
  // Cells are equal modulo 2^32, so that cameras beyond 2^31 m have one too.
  block.camera_cell = glm::ivec4(glm::ivec3(glm::uvec3(glm::i64vec3(cell))), 0);
  block.camera_fraction = glm::vec4(glm::dvec4(view.eye - cell, 0));
  const glm::dvec2 band(guard);
  block.attachment = glm::vec4(glm::dvec4(band, 1.0 / (size + 2.0 * band)));
  block.planes = glm::vec4(glm::dvec4(view.nearPlane, view.farPlane, view.orthographic ? 1 : 0, 0));
  return block;
}

grisaille_view effectView(const scene::View& view) {
  grisaille_view result{};
  result.struct_size = sizeof(result);
  result.orthographic = view.orthographic ? 1 : 0;
  std::memcpy(result.position, &view.eye, sizeof(result.position));
  std::memcpy(result.world_from_view, &view.worldFromView, sizeof(result.world_from_view));
  const glm::dvec4 place(view.scale, view.offset);
  std::memcpy(result.view_from_pixel, &place, sizeof(result.view_from_pixel));
  result.near_plane = view.nearPlane;
  result.far_plane = view.farPlane;
  result.jitter[0] = view.jitter.x;
  result.jitter[1] = view.jitter.y;
  return result;
}

}  // namespace grisaille::frame
