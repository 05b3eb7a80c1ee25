// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(UNIFORM(0), std140) uniform Values {
  uint count;
  uint factor;
  uint offset;
} values;
layout(STORAGE(0), std430) writeonly buffer Out { uint data[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < values.count) data[i] = i * values.factor + values.offset;
}
