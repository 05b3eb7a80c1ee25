#version 460
// SPDX-License-Identifier: MIT
// Copies a picture to one of the format FORMAT and of the same size.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D from;
layout(IMAGE(0), FORMAT) writeonly uniform image2D to;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(to)))) return;
  imageStore(to, pixel, textureLod(from, (vec2(pixel) + 0.5) / vec2(imageSize(to)), 0.0));
}
