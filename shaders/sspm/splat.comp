#version 460
// SPDX-License-Identifier: MIT
// Mode `per_shot`, last pass: thresholds the blended shots against the noise.
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"
#include "outputs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const bool kOwners = false;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D paint;   // see per_shot.glsl
layout(TEXTURE(2)) uniform sampler2D owners;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  const vec4 sum = textureLod(paint, uv, 0.0);
  const uint owner = kOwners ? uint(textureLod(owners, uv, 0.0).y) : 0u;
  writePaint(pixel, sum.rgb, sum.a, owner, splatNoise(fromCamera(at, depth), depth, kOctaves));
}
