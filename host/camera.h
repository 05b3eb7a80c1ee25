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

// Effects know pinholes alone. An orthographic camera becomes one from so far behind that over the
// depth between its planes no length is wrong by more than about 1 part in 128, and no direction by
// more than about 0.6 degrees; view depths grow by the way back. Throws kHostCamera, kHostValue,
// kHostNull, kHostStruct.
View viewOf(const grisaille_host_frame& frame, uint32_t width, uint32_t height, uint32_t rows);

}  // namespace grisaille::host
