#version 460
// SPDX-License-Identifier: MIT
// Converts view depth to clip depth, reversed with an infinite far plane. Surfaces in front of the
// near plane move to it.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(IMAGE(0), r32f) writeonly uniform image2D clip_depth;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(clip_depth)))) return;
  const float metres = texelFetch(view_depth, pixel, 0).x;
  imageStore(clip_depth, pixel, vec4(metres > 0.0 ? min(source.shift.y / metres, 1.0) : 0.0));
}
