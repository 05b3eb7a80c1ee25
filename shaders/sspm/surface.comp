#version 460
// SPDX-License-Identifier: MIT
// Mode `surface` at full resolution: each pixel walks the list of its cell.
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"
#include "outputs.glsl"
#include "walk.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  const vec3 from_camera = fromCamera(at, depth);
  const float noise = splatNoise(from_camera, depth, kOctaves);
  const float enough = enoughAlpha(noise);
  Sum sum = Sum(vec3(0.0), 1.0, 0.0, 0.0, 0u);
  if (depth > 0.0) sum = walk(from_camera, textureLod(facet_normal, uv, 0.0).xyz, enough);
  writePaint(pixel, sum.color, sum.alphas, sum.owner, noise);
}
