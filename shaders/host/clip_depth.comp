#version 460
// SPDX-License-Identifier: MIT
// Converts view depth to clip depth, as clipDepthOf() of common/view.glsl does. Surfaces in front of
// the near plane move to it.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(IMAGE(0), r32f) writeonly uniform image2D clip_depth;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(clip_depth)))) return;
  const float metres = texelFetch(view_depth, pixel, 0).x;
  const vec2 planes = source.planes.xy;
  float clip = planes.x / max(metres, 1e-30);
  if (orthographic()) clip = (planes.y - metres) / (planes.y - planes.x);
  imageStore(clip_depth, pixel, vec4(metres > 0.0 ? clamp(clip, 0.0, 1.0) : 0.0));
}
