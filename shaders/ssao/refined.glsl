// SPDX-License-Identifier: MIT
// Denoiser of the listed pixels, after the pass that computes them: the mean of the 5x5 pixels
// around, weighted by their distance from the pixel's tangent plane. 5x5 pixels hold every point of
// the noise pattern of slices.glsl. Pixels that are not on the list are upsampled and have no
// noise. The mean is corrected by fit.glsl. The share of a pixel that keeps its upsampled value is not
// averaged. In one pass: over rows, then columns, it would cost half and err 2 % more, 4 % on leaves.
//
// One invocation computes a block of 2x2 pixels, which share most of the pixels around them.
// BENT is 0 or 1; 1 also averages the mean open directions, and turns them into world space.
#define ORTHOGRAPHIC_ID 7
#include "common/view.glsl"
#include "finish.glsl"
#include "fit.glsl"
#include "listed.glsl"
#include "plane.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 finish;      // see finished() in finish.glsl
  float tolerance;  // inverse of the plane tolerance, 1 / metres
} settings;
// All nearest and clamped. blocks, upsampled_bent, kept: see upsample.glsl. raw, raw_bent: valid at
// listed pixels.
layout(TEXTURE(0)) uniform usampler2D blocks;
layout(TEXTURE(1)) uniform sampler2D raw;
layout(TEXTURE(2)) uniform sampler2D view_depth;
layout(TEXTURE(3)) uniform sampler2D world_normal;
layout(TEXTURE(6)) uniform sampler2D kept;
#if BENT
layout(TEXTURE(4)) uniform sampler2D upsampled_bent;
layout(TEXTURE(5)) uniform sampler2D raw_bent;
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_target;
#endif
layout(IMAGE(0), r16f) writeonly uniform image2D target;

// The 2x2 pixels of a block, in the order of `blocks`. Planes are in tolerances, slopes per pixel.
struct Four {
  vec4 depth, facing, slope_x, slope_y;
};

Four fourAt(ivec2 place) {
  Four four;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec2 pixel = vec2(place + ivec2(i & 1, i >> 1)) + 0.5;
    const float depth = textureLod(view_depth, attachmentAt(pixel), 0.0).x;
    const vec3 world = textureLod(world_normal, attachmentAt(pixel), 0.0).xyz;
    const Plane plane = planeOf(pixel, viewNormal(world));
    const float tolerance = toleranceAt(depth, settings.tolerance);
    four.depth[i] = depth;
    four.facing[i] = plane.facing * tolerance;
    four.slope_x[i] = plane.slope.x * tolerance;
    four.slope_y[i] = plane.slope.y * tolerance;
  }
  return four;
}

// place: the first pixel of the block
void denoise(ivec2 place) {
  const Four own = fourAt(place);
  const ivec2 size = ivec2(view.size.xy);
  const vec2 block_size = 1.0 / ceil(view.size.xy * 0.5);
  // One component for each of the four pixels.
  vec4 sum = vec4(0.0), weights = vec4(0.0), shares = vec4(0.0), kept_open = vec4(0.0);
  vec4 offset_x = vec4(0.0), square_x = vec4(0.0), product_x = vec4(0.0);
  vec4 offset_y = vec4(0.0), square_y = vec4(0.0), product_y = vec4(0.0);
#if BENT
  mat4x3 bent = mat4x3(0.0);
#endif
  uint own_bytes = 0u;
  for (int b = 0; b < 9; ++b) {
    const ivec2 corner = place + 2 * (ivec2(b % 3, b / 3) - 1);
    const ivec2 inside = clamp(corner, ivec2(0), size - 1);
    const uint bytes = textureLod(blocks, (vec2(inside / 2) + 0.5) * block_size, 0.0).x;
    if (b == 4) own_bytes = bytes;
    [[unroll]] for (int i = 0; i < 4; ++i) {
      const ivec2 pixel = corner + ivec2(i & 1, i >> 1);
      const ivec2 other = clamp(pixel, ivec2(0), size - 1);
      const vec2 apart = vec2(pixel - place);
      const vec4 x = apart.x - vec4(0.0, 1.0, 0.0, 1.0), y = apart.y - vec4(0.0, 0.0, 1.0, 1.0);
      const float depth = textureLod(view_depth, attachmentAt(vec2(other) + 0.5), 0.0).x;
      const vec4 off = abs((depth - own.depth) * own.facing +
                           depthScale(depth) * (own.slope_x * x + own.slope_y * y));
      const vec4 near = vec4(lessThan(max(abs(x), abs(y)), vec4(2.5)));
      const vec4 weight = depth > 0.0 ? max(1.0 - off, 0.0) * near : vec4(0.0);
      const uint upsampled = bytes >> uint((other.x & 1) * 8 + (other.y & 1) * 16) & 0xffu;
      const vec2 at = (vec2(other) + 0.5) * view.size.zw;
      const bool is_listed = upsampled == kIsListed;
      const float open = is_listed ? textureLod(raw, at, 0.0).x : float(upsampled) / 254.0;
      sum += weight * open;
      weights += weight;
      offset_x += weight * x;
      offset_y += weight * y;
      square_x += weight * x * x;
      square_y += weight * y * y;
      product_x += weight * x * open;
      product_y += weight * y * open;
#if BENT
      bent += outerProduct(is_listed ? textureLod(raw_bent, at, 0.0).xyz
                                     : textureLod(upsampled_bent, at, 0.0).xyz, weight);
#endif
    }
  }
  const vec4 inverse = 1.0 / max(weights, 1e-6);  // a listed pixel's own weight is 1
  const vec4 mean = sum * inverse;
  const vec4 fitted =
      mean + changeToCentre(mean, offset_x * inverse, square_x * inverse, product_x * inverse) +
      changeToCentre(mean, offset_y * inverse, square_y * inverse, product_y * inverse);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec2 here = (vec2(place + ivec2(i & 1, i >> 1)) + 0.5) * view.size.zw;
    const vec2 old = textureLod(kept, here, 0.0).xy;
    kept_open[i] = old.x;
    shares[i] = old.y;
  }
  const vec4 open =
      finished(mix(kept_open, clamp(fitted, 0.0, 1.0), shares), settings.finish);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const ivec2 pixel = place + ivec2(i & 1, i >> 1);
    if ((own_bytes >> uint(8 * i) & 0xffu) != kIsListed) continue;
    imageStore(target, pixel, vec4(open[i]));
#if BENT
    const vec2 here = (vec2(pixel) + 0.5) * view.size.zw;
    const vec3 direction = mix(textureLod(upsampled_bent, here, 0.0).xyz, bent[i] * inverse[i],
                               shares[i]);
    const vec3 world = textureLod(world_normal, attachmentAt(vec2(pixel) + 0.5), 0.0).xyz;
    imageStore(bent_target, pixel, vec4(bentNormal(direction, world), 0.0));
#endif
  }
}

void main() {
  const uint end = min(block_count, blockRoom());
  for (uint i = listedFirst(); i < end; i += listedStride()) denoise(listedBlock(i));
}
