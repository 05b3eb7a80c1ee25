// SPDX-License-Identifier: MIT
// Denoiser, third pass: averages along edges, where rows and columns have few texels of one
// surface: on a ledge a few texels wide, or next to a crease. The bilateral weights are those of
// denoise.glsl: a tent over the distance along the edge, times the range weight of the facet's
// plane. The edge's strength blends the result with the input, so that nothing changes in a plane.
//
// LAST is 1 in the pass that applies finished(). BENT is 0 or 1; 1 also averages the mean open
// directions, and LAST then turns them into world space.
#include "filter.glsl"

layout(constant_id = 0) const uint kReach = 6u;  // texels to each side, 2 ... 32; a tap every 2
layout(constant_id = 1) const uint kScale = 1u;  // pixels per texel, each way

struct Surface {
  vec2 at, texel;  // texture coordinates; size of a texel in them
  float depth;
  Plane plane;     // in units of the tolerance, slope per texel
};

// Distance of the surface `across` texels away, at view depth `other`, from the facet's plane, in
// tolerances. Sky is far away.
float offSurface(Surface s, float other, vec2 across) {
  return other > 0.0 ? planeDistance(s.plane, s.depth, other, across) : 1e9;
}

float depthAt(vec2 at) {
  return textureLod(source, at, 0.0).y;
}

// Direction (xy, the larger component is 1) and strength (z, 0 to 1) of the edge near a surface.
// Sums the second moments of the directions to eight texels a knight's move away, as the cosine and
// sine of twice each angle. The weight of a texel is its distance from the plane, up to half a
// tolerance. The edge is the minor axis. Its strength follows from the length of the sum.
vec3 edgeDirection(Surface s) {
  vec2 moments = vec2(0.0);  // cosine and sine of twice the angle
  [[unroll]] for (int k = 0; k < 4; ++k) {
    const vec2 way = vec2((k & 1) + 1, 2 - (k & 1)) * vec2(1 - (k & 2), 1);
    const float ahead = offSurface(s, depthAt(s.at + way * s.texel), way);
    const float behind = offSurface(s, depthAt(s.at - way * s.texel), -way);
    const float off = min(2.0 * ahead, 1.0) + min(2.0 * behind, 1.0);
    moments += off * vec2(way.x * way.x - way.y * way.y, 2.0 * way.x * way.y) / 5.0;
  }
  const float strength = length(moments);
  const vec2 along = moments.x < 0.0 ? vec2(strength - moments.x, -moments.y)
                                     : vec2(-moments.y, strength + moments.x);
  const float larger = max(max(abs(along.x), abs(along.y)), 1e-6);
  return vec3(along / larger, clamp(2.0 * strength - 0.5, 0.0, 1.0));
}

// Bilateral weight of a texel on the edge: the spatial weight times the range weight.
float bilateralWeight(Surface s, float other, vec2 across, float spatial) {
  return spatial * max(1.0 - offSurface(s, other, across), 0.0);
}

// w: `open`, the visibility. xyz: with BENT the mean open direction at texture coordinates `at`,
// else 0.
vec4 texelAt(vec2 at, float open) {
#if BENT
  return vec4(textureLod(source_bent, at, 0.0).xyz, open);
#else
  return vec4(0.0, 0.0, 0.0, open);
#endif
}

vec4 alongEdge(Surface s, vec3 edge, vec4 own) {
  float weights = float(kReach + 1u);
  vec4 sum = weights * own;
  const vec2 way = edge.xy;
  // A loop of no iterations instead of a branch: software drivers execute branches that no texel
  // takes.
  const uint reach = edge.z > 0.0 ? kReach : 0u;
  for (uint i = 2u; i <= reach; i += 2u) {
    // 0.501 and not 0.5: rounding errors do not decide at directions that are ratios of small
    // integers.
    const vec2 on = floor(way * float(i) + 0.501), back = floor(way * -float(i) + 0.501);
    const vec2 ahead = s.at + on * s.texel, behind = s.at + back * s.texel;
    const vec2 a = textureLod(source, ahead, 0.0).xy, b = textureLod(source, behind, 0.0).xy;
    const float spatial = float(kReach + 1u - i);
    const float weightA = bilateralWeight(s, a.y, on, spatial);
    const float weightB = bilateralWeight(s, b.y, back, spatial);
    sum += weightA * texelAt(ahead, a.x) + weightB * texelAt(behind, b.x);
    weights += weightA + weightB;
  }
  return mix(own, sum / weights, edge.z);
}

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(target);
  if (any(greaterThanEqual(texel, size))) return;
  const vec2 inverse = 1.0 / vec2(size);
  const vec2 at = (vec2(texel) + 0.5) * inverse;
  const vec2 own = textureLod(source, at, 0.0).xy;
  vec4 value = texelAt(at, own.x);
  const vec2 pixel = vec2(texel) * float(kScale) + 0.5;
  const Plane plane = planeOfTangent(pixel, unpackHalf2x16(textureLod(tangents, at, 0.0).x));
  const float tolerance = toleranceAt(own.y, settings.tolerance, kTexelTolerance * float(kScale));
  const Surface s = Surface(at, inverse, own.y, Plane(plane.slope * float(kScale) * tolerance,
                                                      plane.facing * tolerance));
  if (own.y > 0.0) value = alongEdge(s, edgeDirection(s), value);
#if LAST
  value.w = finished(vec4(value.w), settings.finish).x;
#endif
  imageStore(target, texel, vec4(value.w, own.y, 0.0, 0.0));
#if BENT
#if LAST
  value.xyz = bentNormal(value.xyz, textureLod(world_normal, attachmentAt(pixel), 0.0).xyz);
#endif
  imageStore(bent_target, texel, vec4(value.xyz, 0.0));
#endif
}
