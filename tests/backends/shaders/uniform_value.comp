// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(local_size_x = 1) in;
layout(UNIFORM(0), std140) uniform Value {
  uint index;
  uint value;
} block;
layout(STORAGE(0), std430) buffer Out { uint data[]; };

void main() { data[block.index] = block.value; }
