#version 460
// SPDX-License-Identifier: MIT
// Writes beside its image.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(IMAGE(0), r32f) writeonly uniform image2D first;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  imageStore(first, pixel, vec4(0.5));
  if (pixel == ivec2(0)) imageStore(first, ivec2(-1, 3), vec4(1.0));
}
