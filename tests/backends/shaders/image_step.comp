// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// Reads and writes one image: x -> 3 x + 1.
layout(local_size_x = 8, local_size_y = 8) in;
layout(IMAGE(0), r32ui) uniform uimage2D image;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, imageSize(image)))) {
    imageStore(image, at, imageLoad(image, at) * 3 + 1);
  }
}
