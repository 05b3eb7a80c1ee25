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
  Sum sum = kNothing;
  if (depth > 0.0) {
    const vec3 normal = textureLod(facet_normal, uv, 0.0).xyz;
    uint blocked;
    sum = walk(Point(fromCamera(at, depth), normal, pixelSize(depth)), (kWanted & 2u) != 0u, blocked);
    if ((kWanted & 4u) != 0u) sum.owner = numberOf(sum.owner);
  }
  writePaint(pixel, sum);
}
