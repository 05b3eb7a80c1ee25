// SPDX-License-Identifier: MIT
// The definition (effects/sspm/README.md), one pass per shot: the shot paints pixels whose distance
// to its ray is less than its range and that are not behind the muzzle. Blends colour normally and
// alpha additively. The first shot (FIRST = 1) overwrites the targets, and its ACCESS is writeonly;
// for the other shots ACCESS is empty.
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kOwners = false;  // also write `owners`

layout(UNIFORM(1), std140) uniform Shot {
  vec3 origin;  // point of the ray nearest to the camera, relative to it; world axes, metres
  float range;  // metres
  vec3 direction;
  float full;  // r0, metres: alpha is min(1, r0 / distance to the ray)
  vec3 color;
  float per_fade;   // 1 / share of the range over which alpha fades out at the rim
  float number;     // 1 + the shot's number
  float muzzle;     // position of the muzzle along the ray, from `origin`, metres
} shot;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(IMAGE(0), rgba32f) uniform ACCESS image2D paint;  // rgb: blended colour; a: sum of alphas
layout(IMAGE(1), rg32f) uniform ACCESS image2D owners;   // largest weight in the colour; its shot

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
