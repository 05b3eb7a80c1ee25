#version 460
// SPDX-License-Identifier: MIT
// Reads past its buffer.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(STORAGE(0), std430) readonly buffer Values { float values[]; };  // 64
layout(IMAGE(0), r32f) writeonly uniform image2D first;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(first)))) return;
  imageStore(first, pixel, vec4(values[pixel.x]));
}
