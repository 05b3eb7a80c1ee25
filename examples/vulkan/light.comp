#version 460
// SPDX-License-Identifier: MIT
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, rgba16f) uniform image2D colour;
layout(set = 0, binding = 1) uniform sampler2D visibility;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(colour)))) return;
  imageStore(colour, pixel, imageLoad(colour, pixel) * texelFetch(visibility, pixel, 0).x);
}
