// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// Writes different values to each layer.
layout(local_size_x = 8, local_size_y = 8) in;
layout(IMAGE(0), r32ui) writeonly uniform uimage2DArray image;

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  if (all(lessThan(at, imageSize(image)))) {
    imageStore(image, at, uvec4(at.z * 1000000 + at.y * 1000 + at.x));
  }
}
