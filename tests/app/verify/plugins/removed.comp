#version 460
// SPDX-License-Identifier: MIT
// Declares a texture that the compiler removes, since nothing depends on it.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(IMAGE(0), r32f) writeonly uniform image2D first;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(first)))) return;
  const float depth = textureLod(view_depth, vec2(0.5), 0.0).x;
  const bool never = false;
  imageStore(first, pixel, vec4(never ? depth : 0.5));
}
