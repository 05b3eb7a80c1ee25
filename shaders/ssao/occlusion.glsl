// SPDX-License-Identifier: MIT
// The classic SSAO of one pixel. SPHERE is 1 to sample all around instead of over the surface.
//
// The pixel is put back into view space. A sample point is occluded when the depth buffer, where the
// point projects, holds a surface nearer than the point by more than the bias, and that surface is in
// range of the pixel. Occlusion is the share of occluded points.
#include "common/view.glsl"
#include "finish.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kKernelSize = 64u;
layout(constant_id = 1) const uint kRotation = 0u;    // 0 noise, 1 none
layout(constant_id = 2) const uint kRangeCheck = 0u;  // 0 linear, 1 raw depth, 2 none
layout(constant_id = 3) const bool kFinish = false;   // apply intensity and power: no blur follows

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 kernel[256];  // in the unit sphere, +z away from the surface
  vec4 finish;
  float radius;      // metres
  float bias;        // metres
} settings;
layout(TEXTURE(0)) uniform sampler2D view_depth;  // nearest, clamped: the edge goes on outside
layout(TEXTURE(1)) uniform sampler2D rotations;   // 4x4, repeated
#if !SPHERE
layout(TEXTURE(2)) uniform sampler2D world_normal;
#endif
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;

// What all sample points of a pixel share.
struct Taps {
  vec4 row_x, row_y;  // kernel point and 1 to pixels from the view's axis times view depth
  vec3 row_beyond;    // kernel point to view depth beyond the pixel's, metres
  float depth;        // of the pixel, metres
  float least;        // to the near plane, metres
  float nearest;      // a surface must lie farther beyond the pixel to be in range, metres
  float raw;          // the pixel's raw depth
  float bias;         // metres
  vec2 slope;         // of the surface's inverse view depth, a pixel; 1 / m
};

// What drawing into a depth buffer of floats and the way back may lose, of a view depth; what a normal
// of half floats is off by, radians; and a place in the picture, of its size.
const float kDepthRounding = 5e-7, kNormalRounding = 5e-4, kPlaceRounding = 2.5e-7;

// A surface must not occlude itself. Its normal may be off, so that sample points lie under it; and a
// tap is the middle of a pixel, beside the place where the point projects or, where the picture ends,
// far from there: the point goes there along the surface's plane, whose inverse view depth is linear
// over the picture.
void keepOpen(inout Taps taps, vec2 pixel, float depth, vec3 normal) {
  const Plane plane = planeOf(pixel, normal);
  const float facing = max(-plane.facing, 1e-3);
  taps.slope = -plane.slope / (depth * facing);
  const float turned = kNormalRounding / facing;
  const float aside = turned * view.view_from_pixel.x / facing;
  const float place = depth * kPlaceRounding * dot(abs(taps.slope), view.size.xy);
  taps.bias += settings.radius * (turned + aside) + depth * (aside + place);
}

// 1 when sample point i is occluded.
float tap(Taps taps, uint i) {
  const vec4 point = vec4(settings.kernel[i].xyz, 1.0);
  // Depths are compared from the pixel's on: the radius may be lost in the rounding of a far
  // surface's depth.
  const float beyond = dot(taps.row_beyond, point.xyz);
  const float point_depth = max(taps.depth + beyond, view.camera_fraction.w);
  const float inverse = 1.0 / point_depth;
  const vec2 at = vec2(dot(taps.row_x, point), dot(taps.row_y, point)) * inverse + view.pixel_from_view.zw;
  const vec2 middle = clamp(floor(at) + 0.5, vec2(0.5), view.size.xy - 0.5);
  const float surface = textureLod(view_depth, middle * view.size.zw, 0.0).x;
  const float apart = surface - taps.depth;
  // The point's view depth there is point_depth / (1 + turned).
#if SPHERE
  const float turned = 0.0;
#else
  const float turned = point_depth * dot(taps.slope, middle - at);
#endif
  // Nothing is nearer than the near plane. Linear range check: a surface nearer than the point is in
  // range when it is not nearer than the pixel by the radius. The sky, depth 0, never is.
  const bool nearer = apart + taps.bias + turned * surface < beyond && beyond > taps.least;
  bool hit = nearer && apart > taps.nearest;
  if (kRangeCheck == 1u) {
    hit = hit && abs(taps.raw - view.camera_fraction.w / surface) < settings.radius;
  }
  return hit ? 1.0 : 0.0;
}

// Taps are written out, since an index that is a constant lets drivers read a sample point once for
// all pixels (12 % of the pass on llvmpipe), and GLSL has no way to ask for it. kKernelSize is known
// when the pipeline is made: what is over it is not there.
#define TAP(i) if ((i) < kKernelSize) occluded += tap(taps, (i));
#define TAP4(i) TAP(i) TAP((i) + 1u) TAP((i) + 2u) TAP((i) + 3u)
#define TAP16(i) TAP4(i) TAP4((i) + 4u) TAP4((i) + 8u) TAP4((i) + 12u)

float occlusionAt(ivec2 pixel, float depth) {
  const vec2 centre = vec2(pixel) + 0.5;
  const vec3 position = viewPosition(centre, depth);
  Taps taps;
  taps.bias = settings.bias + depth * kDepthRounding;
  taps.slope = vec2(0.0);
#if SPHERE
  mat3 axes = mat3(1.0);
#else
  const vec3 normal = viewNormal(textureLod(world_normal, centre * view.size.zw, 0.0).xyz);
  mat3 axes = basisAbout(normal);
  keepOpen(taps, centre, depth, normal);
#endif
  if (kRotation == 0u) {
    const vec2 turn = textureLod(rotations, centre * 0.25, 0.0).xy;
    axes = mat3(axes[0] * turn.x + axes[1] * turn.y, axes[1] * turn.x - axes[0] * turn.y, axes[2]);
  }
  // From kernel space to pixels times view depth, and to view depth, at once: a sample
  // point then costs three dot products, one division and one fetch.
  const vec2 scale = view.pixel_from_view.xy;
  axes *= settings.radius;
  taps.row_x = vec4(vec3(axes[0].x, axes[1].x, axes[2].x) * scale.x, position.x * scale.x);
  taps.row_y = vec4(vec3(axes[0].y, axes[1].y, axes[2].y) * scale.y, position.y * scale.y);
  taps.row_beyond = -vec3(axes[0].z, axes[1].z, axes[2].z);
  taps.depth = depth;
  taps.least = view.camera_fraction.w - depth;
  taps.nearest = kRangeCheck == 0u ? max(-settings.radius, -depth) : -depth;
  taps.raw = view.camera_fraction.w / depth;

  float occluded = 0.0;
  TAP16(0u) TAP16(16u) TAP16(32u) TAP16(48u)
  for (uint i = 64u; i < kKernelSize; i += 4u) {
    TAP4(i)
  }
  return occluded / float(kKernelSize);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(visibility)))) return;
  const float depth = textureLod(view_depth, (vec2(pixel) + 0.5) * view.size.zw, 0.0).x;
  float open = 1.0;
  if (depth > 0.0) open -= occlusionAt(pixel, depth);
  if (kFinish) open = finished(vec4(open), settings.finish).x;
  imageStore(visibility, pixel, vec4(open));
}
