// SPDX-License-Identifier: MIT
// The camera as effects get it: in double precision for their host code, in single for shaders.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"
#include "grisaille/effect.h"

namespace grisaille::frame {

// shaders/common/view.glsl, std140. Field meanings stand there.
struct ViewBlock {
  glm::vec4 view_from_pixel;
  glm::vec4 pixel_from_view;
  glm::vec4 size;
  glm::mat4 view_from_world;
  glm::ivec4 camera_cell;
  glm::vec4 camera_fraction;
  glm::vec4 attachment;
};

// `guard`: pixels by which attachments go beyond the picture on each side.
ViewBlock viewBlock(const scene::Camera& camera, uint32_t width, uint32_t height,
                    uint32_t guard = 0);
// The camera whose picture goes so many pixels beyond on each side; pixels are of the same size.
scene::Camera widened(const scene::Camera& camera, uint32_t height, uint32_t guard);

grisaille_view viewOf(const scene::Camera& camera, uint32_t width, uint32_t height);

}  // namespace grisaille::frame
