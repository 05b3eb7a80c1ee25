#version 460
// SPDX-License-Identifier: MIT
// A picture with its rows from the top as one with its rows from where the other program has them,
// or the other way round; FORMAT is that of the picture written, SAMPLED what the other is.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform SAMPLED from;
layout(IMAGE(0), FORMAT) writeonly uniform TARGET to;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(to);
  if (any(greaterThanEqual(pixel, size))) return;
  imageStore(to, pixel, texelFetch(from, texelOf(pixel, size.y), 0));
}
