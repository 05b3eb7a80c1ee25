// SPDX-License-Identifier: MIT
// Denoiser of the listed pixels, after the pass that computes them: the mean of the 5x5 pixels
// around, weighted by their distance from the pixel's tangent plane. 5x5 pixels hold every point of
// the noise pattern of slices.glsl. Pixels that are not on the list are upsampled and have no
// noise. The mean is corrected by fit.glsl. The share of a pixel that keeps its upsampled value is not
// averaged. In one pass: over rows, then columns, it would cost half and err 2 % more, 4 % on leaves.
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

void denoise(ivec2 place) {
  const vec2 pixel = vec2(place) + 0.5;
  const float depth = textureLod(view_depth, attachmentAt(pixel), 0.0).x;
  const vec3 world = textureLod(world_normal, attachmentAt(pixel), 0.0).xyz;
  const Plane plane = planeOf(pixel, viewNormal(world));
  const float tolerance = toleranceAt(depth, settings.tolerance);
  const vec2 block_size = 1.0 / ceil(view.size.xy * 0.5);
  vec4 sum = vec4(0.0);  // xyz: mean open direction; w: visibility
  float weights = 0.0;
  vec2 offsets = vec2(0.0), squares = vec2(0.0), products = vec2(0.0);
  for (int i = 0; i < 25; ++i) {
    const ivec2 across = ivec2(i % 5, i / 5) - 2;
    const ivec2 other = clamp(place + across, ivec2(0), ivec2(view.size.xy) - 1);
    const float other_depth = textureLod(view_depth, attachmentAt(vec2(other) + 0.5), 0.0).x;
    const float off = planeDistance(plane, depth, other_depth, vec2(across)) * tolerance;
    const float weight = other_depth > 0.0 ? max(1.0 - off, 0.0) : 0.0;
    const uint block = textureLod(blocks, (vec2(other / 2) + 0.5) * block_size, 0.0).x;
    const uint upsampled = block >> uint((other.x & 1) * 8 + (other.y & 1) * 16) & 0xffu;
    const vec2 at = (vec2(other) + 0.5) * view.size.zw;
    const bool is_listed = upsampled == kIsListed;
    const float open = is_listed ? textureLod(raw, at, 0.0).x : float(upsampled) / 254.0;
    sum.w += weight * open;
    const vec2 weighted = weight * vec2(across);
    offsets += weighted;
    squares += weighted * vec2(across);
    products += weighted * open;
#if BENT
    sum.xyz += weight * (is_listed ? textureLod(raw_bent, at, 0.0).xyz
                                   : textureLod(upsampled_bent, at, 0.0).xyz);
#endif
    weights += weight;
  }
  sum /= weights;  // the pixel's own weight is 1
  const vec2 none = vec2(0.0);
  const vec4 changes = changeToCentre(vec4(sum.w), vec4(offsets / weights, none),
                                      vec4(squares / weights, none), vec4(products / weights, none));
  sum.w = clamp(sum.w + changes.x + changes.y, 0.0, 1.0);
  const vec2 here = pixel * view.size.zw, old = textureLod(kept, here, 0.0).xy;
  sum.w = mix(old.x, sum.w, old.y);
#if BENT
  sum.xyz = mix(textureLod(upsampled_bent, here, 0.0).xyz, sum.xyz, old.y);
#endif
  imageStore(target, place, finished(vec4(sum.w), settings.finish));
#if BENT
  imageStore(bent_target, place, vec4(bentNormal(sum.xyz, world), 0.0));
#endif
}

void main() {
  const uint end = listedEnd();
  for (uint i = listedFirst(); i < end; i += listedStride()) denoise(listedPixel(i));
}
