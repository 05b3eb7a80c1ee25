// SPDX-License-Identifier: MIT
// Denoiser: a joint bilateral filter (after Tomasi and Manduchi 1998, "Bilateral Filtering for Gray
// and Color Images"), separated into a pass along rows and a pass along columns. The spatial kernel
// is a tent that is w texels wide at half height. If w is a multiple of 5, the two passes give every
// slice of the 5x5 noise pattern the same weight. The range weight falls linearly with
// the distance of a tap from the plane of the centre's facet, to 0 at the plane tolerance.
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
  vec4 depths, facing, slope;
  [[unroll]] for (int t = 0; t < 4; ++t) {
    const vec2 texel = vec2(first + along * t), at = (texel + 0.5) * inverse;
    depths[t] = textureLod(source, at, 0.0).y;
    const vec2 tangent = unpackHalf2x16(textureLod(tangents, at, 0.0).x);
    const Plane plane = planeOfTangent(texel * float(kScale) + 0.5, tangent);
    const float tolerance = toleranceAt(depths[t], settings.tolerance, kTexelTolerance * float(kScale));
    facing[t] = plane.facing * tolerance;
    slope[t] = dot(plane.slope, vec2(along)) * float(kScale) * tolerance;
  }
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
