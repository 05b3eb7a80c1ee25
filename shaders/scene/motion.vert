#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#include "motion_draw.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 then_position;
// Both from interpolated positions, so that a vertex that the rasteriser snaps moves both alike.
layout(location = 0) out vec4 now;   // clip x, y, w; view depth
layout(location = 1) out vec4 then;

// Same position as in geometry.vert, so that the fragments have equal depth.
invariant gl_Position;

void main() {
  gl_Position = draw.clip_from_object * vec4(position, 1.0);
  now = vec4(gl_Position.xyw, dot(draw.depth_from_object, vec4(position, 1.0)));
  then = vec4((draw.then_clip_from_object * vec4(then_position, 1.0)).xyw,
              dot(draw.then_depth_from_object, vec4(then_position, 1.0)));
}
