// SPDX-License-Identifier: MIT
// Denoiser: a joint bilateral filter (after Tomasi and Manduchi 1998, "Bilateral Filtering for Gray
// and Color Images"), separated into a pass along rows and a pass along columns. The spatial kernel
// is a tent that is w texels wide at half height. If w is a multiple of 5, the two passes give every
// slice of the 5x5 noise pattern the same weight. The range weight falls linearly with
// the distance of a tap from the centre's tangent plane, to 0 at the plane tolerance.
//
// LAST is 1 in the pass that applies finished(). BENT is 0 or 1; 1 also averages the mean open
// directions, and LAST then turns them into world space.
//
// One invocation filters a run of 4 texels, which share most of their taps.
#include "filter.glsl"
#include "fit.glsl"

layout(constant_id = 0) const uint kBlur = 5u;       // width at half height, pixels; 0: 1 texel
layout(constant_id = 1) const uint kScale = 1u;      // pixels per texel, each way
layout(constant_id = 2) const bool kColumn = false;  // along columns, else along rows

// Largest difference between the facet's slope and the interpolated normal's, as the tangent of an
// angle. The slopes on both sides of a texel may differ by an eighth of it.
const float kMostBent = 0.5;

float depthAt(ivec2 texel, vec2 inverse) {
  return textureLod(source, (vec2(texel) + 0.5) * inverse, 0.0).y;
}

vec4 depthScales(vec4 depths) {
  return vec4(depthScale(depths.x), depthScale(depths.y), depthScale(depths.z), depthScale(depths.w));
}

// Slope of the tangent plane along the row or column. Interpolated normals differ from the planes
// of the facets, and weights that follow them leave the noise pattern. If the texels before and
// after a texel lie on a line with it, close to the normal's plane, the result is the slope of that
// line; else it is `slope`, that of the normal. `most` is the largest accepted difference.
vec4 facetSlope(vec4 depths, float before, float after, vec4 facing, vec4 slope, vec4 most) {
  const vec4 back = vec4(before, depths.xyz), on = vec4(depths.yzw, after);
  const vec4 slope_before = (back - depths) * facing / depthScales(max(back, 1e-30));
  const vec4 slope_after = (depths - on) * facing / depthScales(max(on, 1e-30));
  const vec4 facet = 0.5 * (slope_before + slope_after);
  const vec4 apart = max(8.0 * abs(slope_before - slope_after), abs(facet - slope));
  // Sky, depth 0, is not on a line with anything.
  const vec4 sky = 1e30 * vec4(lessThanEqual(min(back, on), vec4(0.0)));
  return mix(slope, facet, lessThan(apart + sky, most));
}

void main() {
  // A branch, not a conditional operator: lavapipe evaluates a vector that a specialization
  // constant selects with the constant's default.
  ivec2 along = ivec2(1, 0);
  if (kColumn) along = along.yx;
  const ivec2 first = ivec2(gl_GlobalInvocationID.xy) * (1 + along * 3);
  const ivec2 size = imageSize(target);
  if (any(greaterThanEqual(first, size))) return;
  const vec2 inverse = 1.0 / vec2(size);

  // One component for each texel of the run. Planes are in tolerances, slopes per texel.
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
  // Sums of k, k k and k visibility.
  vec4 offsets = vec4(0.0), squares = vec4(0.0), products = vec4(0.0);
#if BENT
  mat4x3 bent = mat4x3(0.0);
#endif
  const float width = max(float(kBlur) / float(kScale), 1.0);  // texels
  const int reach = max(int((kBlur + kScale - 1u) / kScale), 1) - 1;
  [[unroll]] for (int i = -reach; i < 4 + reach; ++i) {
    const vec2 from = (vec2(first + along * i) + 0.5) * inverse;
    const vec2 other = textureLod(source, from, 0.0).xy;
    const vec4 k = float(i) - vec4(0.0, 1.0, 2.0, 3.0);
    // Spatial weight times range weight. Sky, depth 0, has none.
    const vec4 plane_distance = abs((other.y - depths) * facing + depthScale(other.y) * (k * slope));
    const vec4 bilateral = max(width - abs(k), 0.0) * max(1.0 - plane_distance, 0.0);
    const vec4 weight = other.y > 0.0 ? bilateral : vec4(0.0);
    sum += weight * other.x;
    weights += weight;
    const vec4 weighted = weight * k;
    offsets += weighted;
    squares += weighted * k;
    products += weighted * other.x;
#if BENT
    bent += outerProduct(textureLod(source_bent, from, 0.0).xyz, weight);
#endif
  }
  const vec4 inverse_weights = 1.0 / max(weights, 1e-6);
  const vec4 mean = sum * inverse_weights;
  const vec4 change = changeToCentre(mean, offsets * inverse_weights, squares * inverse_weights,
                                     products * inverse_weights);
  const vec4 fitted = clamp(mean + change, 0.0, 1.0);
  vec4 open = mix(vec4(1.0), fitted, greaterThan(depths, vec4(0.0)));
#if LAST
  open = finished(open, settings.finish);
#endif
  [[unroll]] for (int t = 0; t < 4; ++t) {
    const ivec2 texel = first + along * t;
    if (any(greaterThanEqual(texel, size))) continue;
    imageStore(target, texel, vec4(open[t], depths[t], 0.0, 0.0));
#if BENT
    vec3 direction = bent[t] * inverse_weights[t];
#if LAST
    direction =
        bentNormal(direction, textureLod(world_normal, attachmentAt(vec2(texel) + 0.5), 0.0).xyz);
#endif
    imageStore(bent_target, texel, vec4(direction, 0.0));
#endif
  }
}
