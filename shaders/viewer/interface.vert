#version 460
// SPDX-License-Identifier: MIT
// Draws Dear ImGui's triangles. Positions are in the window's units, from its top left corner.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(UNIFORM(0)) uniform Interface {
  vec2 clip_from_unit;  // scale of x, of y
  vec2 origin;          // of the window
} interface_;

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 tex_coord;
layout(location = 2) in vec4 tint;
layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 color;

void main() {
  const vec2 place = (position - interface_.origin) * interface_.clip_from_unit;
  gl_Position = vec4(place.x - 1.0, 1.0 - place.y, 1.0, 1.0);
  uv = tex_coord;
  color = tint;
}
