#version 460
// SPDX-License-Identifier: MIT
// Mode `surface` below full resolution, second pass. A pixel looks at the four samples around it
// that have its plane, as in joint bilateral upsampling (Kopf et al. 2007). It composites only the
// shots that own them, but these exactly, so that rims and splats are as fine as at full
// resolution. Pixels that the parameter `refine` selects go on a list for rest.comp instead. One
// thread computes the pixels between four samples, which it reads once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "splat.glsl"
#include "outputs.glsl"
#include "walk.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const uint kStep = 2;    // pixels
layout(constant_id = 3) const uint kRefine = 1;  // the parameter `refine`: nothing, rims
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
layout(TEXTURE(2)) uniform sampler2D samples;  // outputs of samples.comp
layout(TEXTURE(3)) uniform sampler2D planes;
layout(STORAGE(4), std430) buffer Rest {
  uint rest_count;
  uint rest[];  // x | y << 16
};

const float kSameFacing = 0.9;  // least cosine between the facets' normals of pixel and sample
const float kOffPlane = 0.5;    // plane tolerance, in pixels' widths

// The four samples around a pixel, by rows; see samples.comp.
struct Corners {
  vec4 plane[4];
  vec4 owner, blocked, before, strengths;
  uvec4 number;  // 1 + the number of the owner's shot; 0: no paint
  bvec4 full;    // alpha is 1
};

float sumOf(vec4 v) {
  return dot(v, vec4(1.0));
}

uint newestOf(uvec4 numbers) {
  return max(max(numbers.x, numbers.y), max(numbers.z, numbers.w));
}

// Numbers of the owners of the samples that have a weight.
uvec4 numbersOf(Corners corners, vec4 weights) {
  return corners.number * uvec4(greaterThan(weights, vec4(0.0)));
}

// Composites the owners of the samples around a pixel, newest first.
// weights: of the samples, 0 if they are not on the pixel's plane. served: some are.
Sum compositeOwners(Corners corners, vec4 weights, bool served, Point point) {
  const vec4 on_plane = vec4(greaterThan(weights, vec4(0.0)));
  uvec4 left = numbersOf(corners, weights);
  uint newest = newestOf(left);
  // Samples that agree and have full alpha leave nothing to ask.
  const vec4 agree = vec4(equal(left, uvec4(newest))) * vec4(corners.full);
  const bool plain = served && all(greaterThanEqual(agree, on_plane));
  Sum sum = kNothing;
  while (newest > 0u && !plain && isOpen(sum, false)) {
    const vec4 its = weights * vec4(equal(left, uvec4(newest)));
    const float owner = dot(its, corners.owner) / sumOf(its);
    const uint record = uint(owner + 0.5) - 1u;
    const Shot shot = shots[record];
    // At a silhouette that hides the pixel from the muzzle, the larger part of the samples decides.
    const float seen = dot(weights, vec4(greaterThanEqual(corners.number, uvec4(newest))));
    const float hidden = dot(weights, vec4(lessThan(abs(corners.blocked - owner), vec4(0.5))));
    if (seen >= hidden && isReached(record, point)) {
      const vec2 across = fromMuzzle(record, point.from_camera) * axesAcross(shot.direction);
      sum.strengths = max(sum.strengths, dot(its, corners.before) / sumOf(its));
      compositeShot(sum, record, shot, across, point.pixel);
    }
    left *= uvec4(notEqual(left, uvec4(newest)));
    newest = newestOf(left);
  }
  if (plain && newest > 0u) {
    sum.owner = uint(max(max(corners.owner.x * on_plane.x, corners.owner.y * on_plane.y),
                         max(corners.owner.z * on_plane.z, corners.owner.w * on_plane.w)));
    sum.color = colorOf(shots[sum.owner - 1u]);
    sum.alpha = 1.0;
  }
  if (served) sum.strengths = dot(weights, corners.strengths) / sumOf(weights);
  return sum;
}

// Upsamples one pixel, or appends it to the list. share: its position between the samples, 0 to 1.
void upsamplePixel(Corners corners, ivec2 pixel, vec2 share) {
  const vec2 at = vec2(pixel) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  const Point point = Point(fromCamera(at, depth), textureLod(facet_normal, uv, 0.0).xyz, pixelSize(depth));
  vec4 weights = vec4((1.0 - share.x) * (1.0 - share.y), share.x * (1.0 - share.y), (1.0 - share.x) * share.y, share.x * share.y);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec4 plane = corners.plane[i];
    const bool on_plane = dot(plane.xyz, point.normal) >= kSameFacing &&
                          abs(dot(plane.xyz, point.from_camera) - plane.w) <= kOffPlane * point.pixel;
    weights[i] = on_plane ? weights[i] : 0.0;
  }
  const bool served = sumOf(weights) > 0.0;
  // No sample on the plane, and no refinement: asks the owners of all samples.
  if (!served) weights = vec4(depth > 0.0 ? 0.25 : 0.0);
  const uvec4 numbers = numbersOf(corners, weights);
  const vec4 agree = vec4(equal(numbers, uvec4(newestOf(numbers))));
  const bool rim = any(lessThan(agree, vec4(greaterThan(weights, vec4(0.0)))));
  if (depth > 0.0 && kRefine != 0u && (!served || rim)) {
    rest[atomicAdd(rest_count, 1u)] = uint(pixel.x) | uint(pixel.y) << 16;
  } else {
    Sum sum = compositeOwners(corners, weights, served, point);
    if ((kWanted & 4u) != 0u) sum.owner = numberOf(sum.owner);
    writePaint(pixel, sum);
  }
}

void main() {
  const vec2 cell = vec2(gl_GlobalInvocationID.xy);
  const ivec2 first = ivec2(gl_GlobalInvocationID.xy * kStep);
  const ivec2 size = ivec2(view.size.xy);
  if (any(greaterThanEqual(first, size))) return;
  const vec2 texel = 1.0 / vec2(textureSize(samples, 0));
  Corners corners;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec2 place = (cell + vec2(i & 1, i >> 1) + 0.5) * texel;
    const vec4 one = textureLod(samples, place, 0.0);
    corners.plane[i] = textureLod(planes, place, 0.0);
    corners.owner[i] = one.x;
    corners.number[i] = numberOf(uint(one.x));
    corners.blocked[i] = one.y;
    corners.before[i] = one.z;
    corners.full[i] = one.w >= 2.0;
    corners.strengths[i] = one.w >= 2.0 ? one.w - 2.0 : one.w;
  }
  // The last two samples of a row or a column may be closer together.
  const vec2 across = max(min(vec2(kStep), vec2(size - 1 - first)), 1.0);
  for (uint i = 0u; i < kStep * kStep; ++i) {
    const ivec2 inside = ivec2(i % kStep, i / kStep);
    const ivec2 pixel = first + inside;
    if (all(lessThan(pixel, size))) upsamplePixel(corners, pixel, vec2(inside) / across);
  }
}
