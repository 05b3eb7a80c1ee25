// SPDX-License-Identifier: MIT
// One shot over all pixels, by the definition: painted is what lies nearer to the shot's ray than
// its range and not behind the muzzle. Normal blend for colour, additive blend for alpha. ACCESS is
// writeonly for the first shot, whose picture replaces whatever is there, and empty for others.
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kOwners = false;  // keep who weighs most

layout(UNIFORM(1), std140) uniform Shot {
  vec3 origin;  // the ray's point nearest to the camera, from there; world axes, metres
  float range;  // metres
  vec3 direction;
  float full;  // r0, metres: alpha is r0 / distance, 1 up to r0
  vec3 color;
  float per_fade;   // 1 / share of the range over which alpha fades out at the rim
  float number;     // of the shot, from 1
  float muzzle;     // along the ray from its point above, metres
} shot;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(IMAGE(0), rgba32f) uniform ACCESS image2D paint;  // colour; sum of alphas
layout(IMAGE(1), rg32f) uniform ACCESS image2D owners;   // greatest weight in the colour; whose

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(paint)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  const float depth = textureLod(view_depth, at * view.size.zw, 0.0).x;
  const vec3 q = transpose(mat3(view.view_from_world)) * viewPosition(at, depth) - shot.origin;
  const float across = length(cross(q, shot.direction));
  const bool hit = depth > 0.0 && dot(q, shot.direction) >= shot.muzzle && across < shot.range;
  vec4 sum = vec4(0.0);
  vec2 owner = vec2(0.0);
#if !FIRST
  if (!hit) return;
  sum = imageLoad(paint, pixel);
  if (kOwners) owner = imageLoad(owners, pixel).xy;
#endif
  if (hit) {
    const float alpha = min(1.0, shot.full / max(across, 1e-6));
    const float fade = min(1.0, (1.0 - across / shot.range) * shot.per_fade);
    sum = vec4(mix(sum.rgb, shot.color, alpha), sum.a + alpha * fade);
    owner.x *= 1.0 - alpha;
    if (alpha > owner.x) owner = vec2(alpha, shot.number);
  }
  imageStore(paint, pixel, sum);
  if (kOwners) imageStore(owners, pixel, vec4(owner, 0.0, 0.0));
}
