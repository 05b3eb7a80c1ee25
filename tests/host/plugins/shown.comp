// SPDX-License-Identifier: MIT
// Copies a texture.
#version 460
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D source;
layout(IMAGE(0), rgba16f) writeonly uniform image2D target;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  imageStore(target, pixel, texelFetch(source, pixel, 0));
}
