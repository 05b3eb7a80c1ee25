// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// Reads every texel of level 0, row by row from the top.
layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D source;
layout(STORAGE(0), std430) writeonly buffer Out { float texels[]; };

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = textureSize(source, 0);
  if (all(lessThan(at, size))) texels[at.y * size.x + at.x] = texelFetch(source, at, 0).r;
}
