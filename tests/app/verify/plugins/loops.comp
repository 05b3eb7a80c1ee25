#version 460
// SPDX-License-Identifier: MIT
// Never ends.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(IMAGE(0), r32f) writeonly uniform image2D first;

void main() {
  float sum = 0.0;
  for (uint n = 1u; n != 0u; n += 2u) sum += 1.0 / float(n);  // odd numbers are never 0
  imageStore(first, ivec2(gl_GlobalInvocationID.xy), vec4(min(sum, 1.0)));
}
