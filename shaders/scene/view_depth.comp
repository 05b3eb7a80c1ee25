#version 460
// SPDX-License-Identifier: MIT
// Converts clip depth to linear view depth in metres.
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D clip_depth;
layout(IMAGE(0), r32f) writeonly uniform image2D view_depth;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(view_depth)))) return;
  const float depth = textureLod(clip_depth, (vec2(pixel) + 0.5) * view.attachment.zw, 0.0).x;
  const float metres = depth > 0.0 ? viewDepthOf(depth) : 0.0;
  imageStore(view_depth, pixel, vec4(metres));
}
