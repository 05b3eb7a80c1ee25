// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(0), std140) uniform Paint { vec4 paint; };
layout(IMAGE(0), rgba8) writeonly uniform image2D image;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(at, imageSize(image)))) imageStore(image, at, paint);
}
