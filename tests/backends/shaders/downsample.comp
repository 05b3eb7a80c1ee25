// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// The mean of 2x2 texels, from one level of a texture to the next.
layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D above;
layout(IMAGE(0), r32f) writeonly uniform image2D below;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(below)))) return;
  const ivec2 last = textureSize(above, 0) - 1;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    sum += texelFetch(above, min(at * 2 + ivec2(i & 1, i >> 1), last), 0).r;
  }
  imageStore(below, at, vec4(sum / 4.0));
}
