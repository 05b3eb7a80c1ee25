#version 460
// SPDX-License-Identifier: MIT
// Reads what other threads write to shared memory, without a barrier.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(IMAGE(0), r32f) writeonly uniform image2D first;
shared float row[64];

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const uint i = gl_LocalInvocationIndex;
  row[i] = 0.0;
  barrier();
  row[i] = fract(float(7 * pixel.y + 3 * pixel.x) / 64.0);
  const float other = row[63u - i];
  if (any(greaterThanEqual(pixel, imageSize(first)))) return;
  imageStore(first, pixel, vec4(other));
}
