// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// out = 2 in + 1, from one buffer to another.
layout(local_size_x = 64) in;
layout(STORAGE(0), std430) readonly buffer In { uint from[]; };
layout(STORAGE(1), std430) writeonly buffer Out { uint to[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < to.length()) to[i] = from[i] * 2 + 1;
}
