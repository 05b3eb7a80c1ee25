// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// Writes four values to one texel each of a float image.
layout(local_size_x = 8, local_size_y = 8) in;
layout(IMAGE(0), r32f) writeonly uniform image2D image;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, imageSize(image)))) {
    imageStore(image, at, vec4(float(at.y) + float(at.x) / 1024.0));
  }
}
