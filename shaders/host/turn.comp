#version 460
// SPDX-License-Identifier: MIT
// Copies a picture between the project's row order, from the top, and the host program's. FORMAT
// and TARGET are the format and the type of the written image, SAMPLED is the sampler type of the
// source.
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
