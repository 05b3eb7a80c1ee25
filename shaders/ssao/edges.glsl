// SPDX-License-Identifier: MIT
// Averages what is at an edge along it, where rows and columns find too little of its surface: on a
// ledge a few texels wide, or next to a crease. Weights fall with the distance, and to 0 at the
// tolerance as in denoise.glsl. How much of it counts grows with how clearly what is off the surface's
// plane lies to the sides of a line: in a plane nothing changes.
// LAST is 1 where intensity and power follow and nothing else. With BENT, which is 0 or 1, the mean
// open directions are averaged alike, and LAST turns them to the world.
#include "filter.glsl"

layout(constant_id = 0) const uint kReach = 6u;  // texels to each side, 2 ... 32; every other counts
layout(constant_id = 1) const uint kScale = 1u;  // pixels a texel, each way

struct Surface {
  vec2 at, texel;  // its texture coordinates, and a texel's size in them
  float depth;
  Plane plane;     // in tolerances, and its slope a texel
};

// How far off the plane what is `across` texels on lies; sky is far off.
float offSurface(Surface s, float other, vec2 across) {
  return other > 0.0 ? offPlane(s.plane, s.depth, other, across) : 1e9;
}

float depthAt(vec2 at) {
  return textureLod(source, at, 0.0).y;
}

// The way along the edge that a surface has near by, its larger part 1, and how clear that is, 0 to 1:
// the lesser axis of the second moments of the directions to what is off the plane by half a tolerance,
// of eight texels a knight's move away.
vec3 edgeOf(Surface s) {
  vec2 moments = vec2(0.0);  // cosine and sine of twice the angle
  [[unroll]] for (int k = 0; k < 4; ++k) {
    const vec2 way = vec2((k & 1) + 1, 2 - (k & 1)) * vec2(1 - (k & 2), 1);
    const float on = offSurface(s, depthAt(s.at + way * s.texel), way);
    const float back = offSurface(s, depthAt(s.at - way * s.texel), -way);
    const float off = min(2.0 * on, 1.0) + min(2.0 * back, 1.0);
    moments += off * vec2(way.x * way.x - way.y * way.y, 2.0 * way.x * way.y) / 5.0;
  }
  const float apart = length(moments);
  const vec2 along = moments.x < 0.0 ? vec2(apart - moments.x, -moments.y)
                                     : vec2(-moments.y, apart + moments.x);
  const float larger = max(max(abs(along.x), abs(along.y)), 1e-6);
  return vec3(along / larger, clamp(2.0 * apart - 0.5, 0.0, 1.0));
}

// What a texel on the edge weighs: such a share, less what it is off the plane.
float weightOf(Surface s, float other, vec2 across, float share) {
  return share * max(1.0 - offSurface(s, other, across), 0.0);
}

// Visibility there, and the open direction where it is asked for.
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
  // Not a branch: software drivers go through those that no texel takes.
  const uint reach = edge.z > 0.0 ? kReach : 0u;
  for (uint i = 2u; i <= reach; i += 2u) {
    // Half a texel, and a little, so that no slope of small numbers hangs on a rounding.
    const vec2 on = floor(way * float(i) + 0.501), back = floor(way * -float(i) + 0.501);
    const vec2 there = s.at + on * s.texel, behind = s.at + back * s.texel;
    const vec2 a = textureLod(source, there, 0.0).xy, b = textureLod(source, behind, 0.0).xy;
    const float share = float(kReach + 1u - i);
    const float weightA = weightOf(s, a.y, on, share);
    const float weightB = weightOf(s, b.y, back, share);
    sum += weightA * texelAt(there, a.x) + weightB * texelAt(behind, b.x);
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
  const vec3 world = textureLod(world_normal, attachmentAt(pixel), 0.0).xyz;
  const Plane plane = planeOf(pixel, viewNormal(world));
  const float tolerance = toleranceAt(own.y, settings.tolerance);
  const Surface s = Surface(at, inverse, own.y, Plane(plane.slope * float(kScale) * tolerance,
                                                      plane.facing * tolerance));
  if (own.y > 0.0) value = alongEdge(s, edgeOf(s), value);
#if LAST
  value.w = finished(vec4(value.w), settings.finish).x;
#endif
  imageStore(target, texel, vec4(value.w, own.y, 0.0, 0.0));
#if BENT
#if LAST
  value.xyz = bentNormal(value.xyz, world);
#endif
  imageStore(bent_target, texel, vec4(value.xyz, 0.0));
#endif
}
