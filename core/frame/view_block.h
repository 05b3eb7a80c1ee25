// SPDX-License-Identifier: MIT
// The camera that effects get: in double precision for their CPU code, in single for shaders.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"
#include "grisaille/effect.h"

namespace grisaille::frame {

// The std140 block of shaders/common/view.glsl, which documents the fields.
struct ViewBlock {
  glm::vec4 view_from_pixel;
  glm::vec4 pixel_from_view;
  glm::vec4 size;
  glm::mat4 view_from_world;
  glm::ivec4 camera_cell;
  glm::vec4 camera_fraction;
  glm::vec4 attachment;
};

// `guard`: pixels by which attachments extend beyond the picture on each side.
ViewBlock viewBlock(const scene::Camera& camera, uint32_t width, uint32_t height,
                    uint32_t guard = 0);
// The camera whose picture extends `guard` pixels further on each side, with the same pixel size.
scene::Camera widened(const scene::Camera& camera, uint32_t height, uint32_t guard);

grisaille_view viewOf(const scene::Camera& camera, uint32_t width, uint32_t height);

}  // namespace grisaille::frame
