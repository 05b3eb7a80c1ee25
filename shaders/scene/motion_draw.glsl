// SPDX-License-Identifier: MIT
// Uniforms of one draw of a surface that moves. See draw.glsl.
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform MotionBlock {
  mat4 clip_from_object;
  mat4 then_clip_from_object;  // of the previous frame's camera, at this frame's size
  vec4 depth_from_object;      // view depth = dot(.., (position, 1))
  vec4 then_depth_from_object;
  vec2 pixels_from_clip;       // half the attachment's width, minus half its height
} draw;
