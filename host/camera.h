// SPDX-License-Identifier: MIT
// Reads a host's camera matrices, and describes how to read its textures.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/view.h"
#include "grisaille/host.h"

namespace grisaille::host {

// The std140 block of shaders/host/source.glsl, which documents the fields.
struct SourceBlock {
  glm::mat4 world_from_view;
  glm::vec4 view_from_pixel;
  glm::vec4 depth;
  glm::vec4 planes;
  glm::ivec4 mode;
  glm::ivec4 place;
};

// The std140 block of shaders/host/motion.comp, which documents the fields.
struct MotionBlock {
  glm::mat4 then_from_view;
  glm::vec4 then_pixel_from_view;
  glm::vec4 shift;
  float known;
  float then_orthographic;
};

struct View {
  scene::View seen;    // what effects get
  SourceBlock source;  // for this view and the frame's textures
};

// The part of the frame's textures that holds the picture. `size`: of the textures. Throws
// kHostValue.
grisaille_host_rectangle rectangleOf(const grisaille_host_frame& frame, const glm::uvec2& size);

// The view of a layer, whose picture lies at `place`. Throws kHostCamera, kHostValue, kHostNull,
// kHostStruct.
View viewOf(const grisaille_host_frame& frame, uint32_t layer,
            const grisaille_host_rectangle& place, uint32_t rows);

// How to read frame.motion. `then`: the view of the previous frame; null: it is not known. Throws
// kHostValue.
MotionBlock motionOf(const grisaille_host_frame& frame, const scene::View& now,
                     const scene::View* then);

}  // namespace grisaille::host
