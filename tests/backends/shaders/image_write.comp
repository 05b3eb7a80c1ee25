// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(IMAGE(0), r32ui) writeonly uniform uimage2D image;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, imageSize(image)))) imageStore(image, at, uvec4(at.y * 65536 + at.x));
}
