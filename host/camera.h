// SPDX-License-Identifier: MIT
// A host's camera as the effects see it, and how its textures are read.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"
#include "grisaille/host.h"

namespace grisaille::host {

// shaders/host/source.glsl, std140. Field meanings stand there.
struct SourceBlock {
  glm::mat4 world_from_view;
  glm::vec4 view_from_pixel;
  glm::vec4 planes;
  glm::vec4 shift;
  glm::ivec4 mode;
};

struct View {
  scene::Camera camera;  // a pinhole: what the effects see
  SourceBlock source;    // of this camera and these textures
};

// An orthographic camera becomes what scene::orthographicCamera() says. Throws kHostCamera,
// kHostValue, kHostNull, kHostStruct.
View viewOf(const grisaille_host_frame& frame, uint32_t width, uint32_t height, uint32_t rows);

}  // namespace grisaille::host
