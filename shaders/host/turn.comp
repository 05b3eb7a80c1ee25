#version 460
// SPDX-License-Identifier: MIT
// Copies a picture between a texture of the library, whose rows begin at the top, and the place of
// the picture in a texture of the host program, in its row order. FORMAT and TARGET are the format and the type of the written image, SAMPLED is the sampler type of the
// source.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

layout(constant_id = 0) const bool kOut = false;  // to the host program's texture, else from it

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform SAMPLED from;
layout(IMAGE(0), FORMAT) writeonly uniform TARGET to;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, source.place.zw))) return;
  if (kOut) {
    imageStore(to, texelOf(pixel), texelFetch(from, pixel, 0));
  } else {
    imageStore(to, pixel, texelFetch(from, texelOf(pixel), 0));
  }
}
