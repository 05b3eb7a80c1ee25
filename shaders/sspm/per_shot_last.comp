#version 460
// SPDX-License-Identifier: MIT
// Mode `per_shot`, last pass: writes the outputs.
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"
#include "outputs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D paint;  // see per_shot.glsl
layout(TEXTURE(1)) uniform sampler2D rest;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  const vec2 uv = (vec2(pixel) + 0.5) * view.size.zw;
  const vec4 color = textureLod(paint, uv, 0.0), others = textureLod(rest, uv, 0.0);
  writePaint(pixel, Sum(color.rgb, color.a, others.x, others.y, 0.0, uint(others.z)));
}
