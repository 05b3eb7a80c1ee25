// SPDX-License-Identifier: MIT
// The camera that effects get: in double precision for their CPU code, in single for shaders.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/view.h"
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
  glm::vec4 planes;
};

// `view`: of the picture. `guard`: pixels by which attachments extend beyond it on each side.
ViewBlock viewBlock(const scene::View& view, uint32_t guard = 0);

grisaille_view effectView(const scene::View& view);

}  // namespace grisaille::frame
