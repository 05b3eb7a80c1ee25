// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// One step of a chain; the result reveals the order of the steps: x -> 3 x + 1.
layout(local_size_x = 64) in;
layout(STORAGE(0), std430) buffer Data { uint data[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < data.length()) data[i] = data[i] * 3 + 1;
}
