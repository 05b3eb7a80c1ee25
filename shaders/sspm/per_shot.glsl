// SPDX-License-Identifier: MIT
// The definition (effects/sspm/README.md), one pass per shot, newest first: the shot paints pixels
// whose distance to its ray is less than its range and that are not behind the muzzle. The first
// pass (FIRST = 1) overwrites the targets, and its ACCESS is writeonly; for the others ACCESS is
// empty.
#include "splat.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// Whether pixels at full alpha still sum up strengths.
layout(constant_id = 0) const bool kCovered = false;

layout(UNIFORM(2), std140) uniform Shot {
  vec3 origin;  // point of the ray nearest to the camera, relative to it; world axes, metres
  float range;  // metres
  vec3 direction;
  float full;  // r0, metres: alpha is min(1, r0 / distance to the ray)
  vec3 color;
  float per_fade;  // 1 / share of the range over which alpha fades out at the rim
  uint number;     // 1 + the shot's number
  float muzzle;    // position of the muzzle along the ray, from `origin`, metres
  uint seed;       // of its splat
  float times;     // number of shots that this one stands for
} shot;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(IMAGE(0), rgba32f) uniform ACCESS image2D paint;  // Sum: color, alpha
layout(IMAGE(1), rgba32f) uniform ACCESS image2D rest;   // Sum: strengths, weight, owner

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(paint)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  const float depth = textureLod(view_depth, at * view.size.zw, 0.0).x;
  const vec3 q = fromCamera(at, depth) - shot.origin;
  const vec2 across = q * axesAcross(shot.direction);
  const bool hit = depth > 0.0 && dot(q, shot.direction) >= shot.muzzle && length(across) < shot.range;
  Sum sum = kNothing;
#if !FIRST
  if (!hit) return;
  const vec4 before = imageLoad(paint, pixel), others = imageLoad(rest, pixel);
  sum = Sum(before.rgb, before.a, others.x, others.y, 0.0, uint(others.z));
#endif
  if (hit && isOpen(sum, kCovered)) {
    composite(sum, across, pixelSize(depth), shot.seed, shot.range, shot.full, shot.per_fade,
              shot.times, shot.color, shot.number);
  }
  imageStore(paint, pixel, vec4(sum.color, sum.alpha));
  imageStore(rest, pixel, vec4(sum.strengths, sum.weight, float(sum.owner), 0.0));
}
