// SPDX-License-Identifier: MIT
// Averages along a row or a column with the weights 1, 2 ... kSize ... 2, 1: after both, every slice
// of the pattern has the same weight where kSize is a multiple of the pattern's 5 texels. Only
// what lies in the plane of the texel's surface counts: the weight falls to 0 at the tolerance.
// LAST is 1 where intensity and power follow and nothing else. With BENT, which is 0 or 1, the mean
// open directions are averaged alike, and LAST turns them to the world.
//
// One invocation does a run of 4 texels, which share most of what they average.
#include "filter.glsl"

layout(constant_id = 0) const uint kSize = 5u;       // half the width, texels, 1 ... 16
layout(constant_id = 1) const uint kScale = 1u;      // pixels a texel, each way
layout(constant_id = 2) const bool kColumn = false;  // down a column, not along a row

// By how much a facet's slope may differ from that of the interpolated normal, as the tangent of an
// angle, and an eighth of that the slopes to both sides from one another.
const float kMostBent = 0.5;

float depthAt(ivec2 texel, vec2 inverse) {
  return textureLod(source, (vec2(texel) + 0.5) * inverse, 0.0).y;
}

// Surfaces are made of facets, whose planes interpolated normals miss: weights that follow the normal
// would leave the noise's pattern. Where a texel and its neighbours before and after it lie on a line,
// and that not far off the normal's plane, theirs is the slope.
vec4 facetSlope(vec4 depths, float before, float after, vec4 facing, vec4 slope, vec4 most) {
  const vec4 back = vec4(before, depths.xyz), on = vec4(depths.yzw, after);
  const vec4 one = (back - depths) * facing / max(back, 1e-30);
  const vec4 two = (depths - on) * facing / max(on, 1e-30);
  const vec4 both = 0.5 * (one + two);
  return mix(slope, both, lessThan(max(8.0 * abs(one - two), abs(both - slope)), most));
}

void main() {
  // By branches: lavapipe takes a vector chosen by a specialization constant for the default's.
  ivec2 along = ivec2(1, 0);
  if (kColumn) along = along.yx;
  const ivec2 first = ivec2(gl_GlobalInvocationID.xy) * (1 + along * 3);
  const ivec2 size = imageSize(target);
  if (any(greaterThanEqual(first, size))) return;
  const vec2 inverse = 1.0 / vec2(size);

  // One component for each texel of the run; planes in tolerances, and the slope a texel.
  vec4 depths, facing, slope, most;
  [[unroll]] for (int t = 0; t < 4; ++t) {
    const vec2 texel = vec2(first + along * t);
    const vec2 pixel = texel * float(kScale) + 0.5;
    depths[t] = depthAt(first + along * t, inverse);
    const vec3 normal = viewNormal(textureLod(world_normal, attachmentAt(pixel), 0.0).xyz);
    const Plane plane = planeOf(pixel, normal);
    const float tolerance = toleranceAt(depths[t], settings.tolerance);
    facing[t] = plane.facing * tolerance;
    slope[t] = dot(plane.slope, vec2(along)) * float(kScale) * tolerance;
    most[t] = kMostBent * abs(view.view_from_pixel.x) * float(kScale) * tolerance /
                 max(abs(plane.facing), 0.5);
  }
  slope = facetSlope(depths, depthAt(first - along, inverse), depthAt(first + along * 4, inverse),
                     facing, slope, most);
  vec4 sum = vec4(0.0), weights = vec4(0.0);
#if BENT
  mat4x3 bent = mat4x3(0.0);
#endif
  const int reach = int(kSize) - 1;
  [[unroll]] for (int i = -reach; i < 4 + reach; ++i) {
    const vec2 from = (vec2(first + along * i) + 0.5) * inverse;
    const vec2 other = textureLod(source, from, 0.0).xy;
    const vec4 k = float(i) - vec4(0.0, 1.0, 2.0, 3.0);
    const vec4 off = abs((other.y - depths) * facing + other.y * (k * slope));
    const vec4 share = max(float(kSize) - abs(k), 0.0) * max(1.0 - off, 0.0);
    const vec4 weight = other.y > 0.0 ? share : vec4(0.0);
    sum += weight * other.x;
    weights += weight;
#if BENT
    bent += outerProduct(textureLod(source_bent, from, 0.0).xyz, weight);
#endif
  }
  vec4 open = mix(vec4(1.0), sum / max(weights, 1e-6), greaterThan(depths, vec4(0.0)));
#if LAST
  open = finished(open, settings.finish);
#endif
  [[unroll]] for (int t = 0; t < 4; ++t) {
    const ivec2 texel = first + along * t;
    if (any(greaterThanEqual(texel, size))) continue;
    imageStore(target, texel, vec4(open[t], depths[t], 0.0, 0.0));
#if BENT
    vec3 mean = bent[t] / max(weights[t], 1e-6);
#if LAST
    mean = bentNormal(mean, textureLod(world_normal, attachmentAt(vec2(texel) + 0.5), 0.0).xyz);
#endif
    imageStore(bent_target, texel, vec4(mean, 0.0));
#endif
  }
}
