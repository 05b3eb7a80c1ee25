// SPDX-License-Identifier: MIT
// Converts a host's camera to the camera that effects see, and describes how to read its textures.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"
#include "grisaille/host.h"

namespace grisaille::host {

// The std140 block of shaders/host/source.glsl, which documents the fields.
struct SourceBlock {
  glm::mat4 world_from_view;
  glm::vec4 view_from_pixel;
  glm::vec4 planes;
  glm::vec4 shift;
  glm::ivec4 mode;
};

struct View {
  scene::Camera camera;  // the pinhole camera that effects see
  SourceBlock source;    // for this camera and its textures
};

// Replaces an orthographic camera by the pinhole camera of scene::orthographicCamera(). Throws
// kHostCamera, kHostValue, kHostNull, kHostStruct.
View viewOf(const grisaille_host_frame& frame, uint32_t width, uint32_t height, uint32_t rows);

}  // namespace grisaille::host
