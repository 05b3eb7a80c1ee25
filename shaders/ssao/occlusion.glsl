// SPDX-License-Identifier: MIT
// Classic SSAO with a kernel of sample points. SPHERE is 1 for points in the whole sphere (Mittring
// 2007, "Finding Next Gen: CryEngine 2", section "Screen-Space Ambient Occlusion"), 0 for points in
// the hemisphere over the surface (Filion and McNaughton 2008, "StarCraft II: Effects and
// Techniques").
//
// 1. Reconstruct the pixel's position in view space from its depth, and raise it along its normal by
//    the bias (sphere: towards the camera).
// 2. Rotate the kernel by the noise tile, and orient it about the normal (hemisphere only).
// 3. Project each sample point and read the depth buffer there (a tap).
// 4. The point is occluded if the tap's depth is nearer than the point and passes the range check.
//    Occlusion is the share of occluded points.
#define ORTHOGRAPHIC_ID 7
#include "common/view.glsl"
#include "finish.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kKernelSize = 64u;
layout(constant_id = 1) const uint kRotation = 0u;    // 0 noise, 1 none
layout(constant_id = 2) const uint kRangeCheck = 0u;  // 0 linear depth, 1 raw depth, 2 none
layout(constant_id = 3) const bool kFinish = false;   // no blur follows: apply finished() here

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 kernel[256];  // sample points in the unit sphere, +z away from the surface
  vec4 finish;       // see finished() in finish.glsl
  float radius;      // metres
  float bias;        // metres
} settings;
layout(TEXTURE(0)) uniform sampler2D view_depth;  // nearest; clamped: repeats the border outside
layout(TEXTURE(1)) uniform sampler2D rotations;   // noise tile: 4x4 (cosine, sine), repeated
#if !SPHERE
layout(TEXTURE(2)) uniform sampler2D world_normal;
#endif
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;

// Values that all sample points of a pixel share. Depth offsets count from the pixel's view depth.
struct Taps {
  // dot(row, (kernel point, 1)): pixels from the view axis, times depthScale()
  vec4 row_x, row_y;
  vec3 row_offset;    // dot(row, kernel point): the sample point's depth offset from the centre's
  float centre;       // depth offset of the sample points' centre, metres
  float depth;        // the pixel's view depth, metres
  float near_offset;  // depth offset of the near plane, metres
  float range_limit;  // range check: least depth offset of an occluder, metres
  float raw_depth;    // the pixel's clip depth
  float tolerance;    // how much nearer than a sample point an occluder must be, metres
  vec2 slope;         // of the plane through the centre: 1 / view depth or, orthographic, -view
                      // depth, per pixel
};

// Rounding errors. Of a view depth that went through the float depth buffer: relative. Of a normal
// in half floats: radians. Of a position in the picture: relative to the picture's size.
const float kDepthRounding = 5e-7, kNormalRounding = 5e-4, kPlaceRounding = 2.5e-7;

// Keeps a surface from occluding itself. Two causes:
// - Rounding of depth, normal and position: taps.tolerance, see effects/ssao/README.md.
// - A tap is the centre of a pixel, beside the projected point, or far from it outside the picture:
//   isOccluded() moves the point there along the tangent plane. The plane's inverse view depth or,
//   orthographic, its view depth is linear over the picture with this slope.
void tolerateRounding(inout Taps taps, vec2 pixel, float depth, vec3 normal) {
  const Plane plane = planeOf(pixel, normal);
  const float facing = max(-plane.facing, 1e-3);
  const float scale = depthScale(depth);
  taps.slope = -plane.slope /
               (scale * facing - perspective() * min(settings.bias, 0.999 * depth * facing));
  const float turned = kNormalRounding / facing;
  const float aside = turned * view.view_from_pixel.x / facing;
  const float place = scale * kPlaceRounding * dot(abs(taps.slope), view.size.xy);
  taps.tolerance += settings.radius * (turned + perspective() * aside) + scale * (aside + place);
}

// Steps 3 and 4: 1 if sample point i is occluded, else 0.
float isOccluded(Taps taps, uint i) {
  const vec4 point = vec4(settings.kernel[i & 255u].xyz, 1.0);
  // Compares offsets from the pixel's depth: a far surface's depth plus a small radius would round
  // to the depth alone.
  const float point_offset = dot(taps.row_offset, point.xyz) + taps.centre;
  const float point_depth = max(taps.depth + point_offset, view.planes.x);
  const float inverse = 1.0 / depthScale(point_depth);
  const vec2 projected =
      vec2(dot(taps.row_x, point), dot(taps.row_y, point)) * inverse + view.pixel_from_view.zw;
  const vec2 tap = clamp(floor(projected) + 0.5, vec2(0.5), view.size.xy - 0.5);
  const float tap_depth = textureLod(view_depth, tap * view.size.zw, 0.0).x;
  const float tap_offset = tap_depth - taps.depth;
  // Moved to the tap, the point has the view depth point_depth / (1 + moved) or, orthographic,
  // point_depth - moved.
#if SPHERE
  const float moved = 0.0;
#else
  const float moved = depthScale(point_depth) * dot(taps.slope, tap - projected);
#endif
  // Depth test. Sample points nearer than the near plane are open.
  const bool in_front = tap_offset + taps.tolerance + moved * depthScale(tap_depth) < point_offset &&
                        point_offset > taps.near_offset;
  // Range check, linear: the tap is less than the radius in front of the pixel. Raw depth compares
  // depth buffer values. The sky, depth 0, never passes.
  bool occluded = in_front && tap_offset > taps.range_limit;
  if (kRangeCheck == 1u) {
    occluded =
        occluded && abs(taps.raw_depth - clipDepthOf(tap_depth)) < settings.radius;
  }
  return occluded ? 1.0 : 0.0;
}

// Points beyond the kernel's 256 are these again, turned about the z axis by the golden section of a
// circle for each 256.
void turn(inout Taps taps) {
  const float c = -0.7373688781, s = -0.6754902942;
  taps.row_x.xy = vec2(c * taps.row_x.x + s * taps.row_x.y, c * taps.row_x.y - s * taps.row_x.x);
  taps.row_y.xy = vec2(c * taps.row_y.x + s * taps.row_y.y, c * taps.row_y.y - s * taps.row_y.x);
  const vec2 offset = taps.row_offset.xy;
  taps.row_offset.xy = vec2(c * offset.x + s * offset.y, c * offset.y - s * offset.x);
}

// Macros unroll the loop over taps: with a constant index, drivers load a sample point once for all
// pixels, which saves 12 % of the pass on llvmpipe, and GLSL cannot request it. kKernelSize is a
// specialization constant: the compiler removes the taps beyond it.
#define TAP(i) if ((i) < kKernelSize) occluded += isOccluded(taps, (i));
#define TAP4(i) TAP(i) TAP((i) + 1u) TAP((i) + 2u) TAP((i) + 3u)
#define TAP16(i) TAP4(i) TAP4((i) + 4u) TAP4((i) + 8u) TAP4((i) + 12u)

float occlusionAt(ivec2 pixel, float depth) {
  const vec2 centre = vec2(pixel) + 0.5;
  Taps taps;
  taps.tolerance = depth * kDepthRounding;
  taps.slope = vec2(0.0);
#if SPHERE
  const vec3 normal = vec3(0.0, 0.0, 1.0);
  mat3 axes = mat3(1.0);
#else
  const vec3 normal = viewNormal(textureLod(world_normal, centre * view.size.zw, 0.0).xyz);
  mat3 axes = basisAbout(normal);
  tolerateRounding(taps, centre, depth, normal);
#endif
  const Raised at = raised(viewPosition(centre, depth), normal, settings.bias);
  if (at.hidden) return 0.0;
  const vec3 position = at.position;
  // Step 2: rotates the kernel about its z axis, by one of 16 angles.
  if (kRotation == 0u) {
    const vec2 rotation = textureLod(rotations, centre * 0.25, 0.0).xy;
    axes = mat3(axes[0] * rotation.x + axes[1] * rotation.y,
                axes[1] * rotation.x - axes[0] * rotation.y, axes[2]);
  }
  // Combines rotation, radius and projection, so that a sample point costs three dot products, one
  // division and one fetch.
  const vec2 scale = view.pixel_from_view.xy;
  axes *= settings.radius;
  taps.row_x = vec4(vec3(axes[0].x, axes[1].x, axes[2].x) * scale.x, position.x * scale.x);
  taps.row_y = vec4(vec3(axes[0].y, axes[1].y, axes[2].y) * scale.y, position.y * scale.y);
  taps.row_offset = -vec3(axes[0].z, axes[1].z, axes[2].z);
  taps.depth = depth;
  taps.centre = -settings.bias * normal.z;
  taps.near_offset = view.planes.x - depth;
  taps.range_limit = kRangeCheck == 0u ? max(taps.centre - settings.radius, -depth) : -depth;
  taps.raw_depth = clipDepthOf(depth + taps.centre);

  float occluded = 0.0;
  TAP16(0u) TAP16(16u) TAP16(32u) TAP16(48u)
  for (uint i = 64u; i < kKernelSize; i += 4u) {
    if ((i & 255u) == 0u) turn(taps);
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
