// SPDX-License-Identifier: MIT
// Denoiser of the refined pixels, after the pass that computes them: the mean of the 5x5 pixels
// around, weighted by their distance from the plane of the pixel's facet. 5x5 pixels hold every point of
// the noise pattern of slices.glsl. Pixels that are not refined are upsampled and have no
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
// All nearest and clamped. blocks, upsampled_bent: see upsample.glsl.
layout(TEXTURE(0)) uniform usampler2D blocks;
layout(TEXTURE(1)) uniform sampler2D view_depth;
layout(TEXTURE(2)) uniform sampler2D world_normal;
#include "facet.glsl"
#if BENT
layout(TEXTURE(3)) uniform sampler2D upsampled_bent;
layout(TEXTURE(4)) uniform sampler2D raw_bent;  // valid at refined pixels
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_target;
#endif
layout(IMAGE(0), r16f) writeonly uniform image2D target;

// Least sum of weights. The upsampled value fills up what is missing: a pixel that is alone on its
// plane would show the noise of its few slices.
const float kFewest = 3.0;

// The 2x2 pixels of a block, in the order of `blocks`. Planes are in tolerances, slopes per pixel.
struct Four {
  vec4 depth, facing, slope_x, slope_y;
};

Four fourAt(ivec2 place) {
  Four four;
  // The depths of two pixels before and two after the block, in both rows and both columns.
  const vec2 first = vec2(place) + 0.5;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    four.depth[i] = depthNear(first + vec2(i & 1, i >> 1));
  }
  vec4 rows[2], columns[2];
  [[unroll]] for (int i = 0; i < 2; ++i) {
    rows[i] = vec4(depthNear(first + vec2(-1, i)), depthNear(first + vec2(-2, i)),
                   depthNear(first + vec2(2, i)), depthNear(first + vec2(3, i)));
    columns[i] = vec4(depthNear(first + vec2(i, -1)), depthNear(first + vec2(i, -2)),
                      depthNear(first + vec2(i, 2)), depthNear(first + vec2(i, 3)));
  }
  // Not unrolled: SwiftShader would simplify four facets that share neighbours without end, and take
  // all memory. On llvmpipe this costs 1 % of `balanced`.
  for (int i = 0; i < 4; ++i) {
    const vec2 pixel = first + vec2(i & 1, i >> 1);
    const float depth = four.depth[i];
    const vec3 world = textureLod(world_normal, attachmentAt(pixel), 0.0).xyz;
    const vec4 row = rows[i >> 1], column = columns[i & 1];
    const float beside = four.depth[i ^ 1], below = four.depth[i ^ 2];
    const vec4 in_row = (i & 1) == 0 ? vec4(row.xy, beside, row.z) : vec4(beside, row.x, row.zw);
    const vec4 in_column =
        (i >> 1) == 0 ? vec4(column.xy, below, column.z) : vec4(below, column.x, column.zw);
    const vec2 tangent = facetTangent(pixel, depth, viewNormal(world), in_row, in_column);
    const Plane plane = planeOfTangent(pixel, tangent);
    const float tolerance = toleranceAt(depth, settings.tolerance, kRefinedTolerance);
    four.facing[i] = plane.facing * tolerance;
    four.slope_x[i] = plane.slope.x * tolerance;
    four.slope_y[i] = plane.slope.y * tolerance;
  }
  return four;
}

#if BENT
vec3 bentAt(vec2 at) {
  const vec4 upsampled = textureLod(upsampled_bent, at, 0.0);
  return upsampled.w > 0.0 ? mix(upsampled.xyz, textureLod(raw_bent, at, 0.0).xyz, upsampled.w)
                           : upsampled.xyz;
}
#endif

void denoise(Block block) {
  const ivec2 place = block.place;
  const Four own = fourAt(place);
  const ivec2 size = ivec2(view.size.xy);
  const vec2 block_size = 1.0 / ceil(view.size.xy * 0.5);
  // One component for each of the four pixels.
  vec4 sum = vec4(0.0), weights = vec4(0.0);
  vec4 offset_x = vec4(0.0), square_x = vec4(0.0), product_x = vec4(0.0);
  vec4 offset_y = vec4(0.0), square_y = vec4(0.0), product_y = vec4(0.0);
#if BENT
  mat4x3 bent = mat4x3(0.0);
#endif
  for (int b = 0; b < 9; ++b) {
    const ivec2 corner = place + 2 * (ivec2(b % 3, b / 3) - 1);
    const ivec2 inside = clamp(corner, ivec2(0), size - 1);
    const uint opens = textureLod(blocks, (vec2(inside / 2) + 0.5) * block_size, 0.0).x;
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
      const float open =
          float(bitfieldExtract(opens, (other.x & 1) * 8 + (other.y & 1) * 16, 8)) / 255.0;
      sum += weight * open;
      weights += weight;
      offset_x += weight * x;
      offset_y += weight * y;
      square_x += weight * x * x;
      square_y += weight * y * y;
      product_x += weight * x * open;
      product_y += weight * y * open;
#if BENT
      bent += outerProduct(bentAt((vec2(other) + 0.5) * view.size.zw), weight);
#endif
    }
  }
  const vec4 upsampled = unpackUnorm4x8(block.open), few = max(kFewest - weights, 0.0);
  sum += few * upsampled;
  const vec4 inverse = 1.0 / max(weights + few, 1e-6);
  const vec4 mean = sum * inverse;
  const vec4 fitted =
      mean + changeToCentre(mean, offset_x * inverse, square_x * inverse, product_x * inverse) +
      changeToCentre(mean, offset_y * inverse, square_y * inverse, product_y * inverse);
  const vec4 shares = unpackUnorm4x8(block.shares);
  const vec4 open = finished(
      mix(upsampled, clamp(fitted, 0.0, 1.0), shares), settings.finish);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const ivec2 pixel = place + ivec2(i & 1, i >> 1);
    if (shares[i] == 0.0) continue;
    imageStore(target, pixel, vec4(open[i]));
#if BENT
    const vec2 here = (vec2(pixel) + 0.5) * view.size.zw;
    const vec3 coarse = textureLod(upsampled_bent, here, 0.0).xyz;
    const vec3 mean_bent = (bent[i] + few[i] * coarse) * inverse[i];
    const vec3 direction = mix(coarse, mean_bent, shares[i]);
    const vec3 world = textureLod(world_normal, attachmentAt(vec2(pixel) + 0.5), 0.0).xyz;
    imageStore(bent_target, pixel, vec4(bentNormal(direction, world), 0.0));
#endif
  }
}

void main() {
  const uint end = blockEnd();
  for (uint i = firstBlock(); i < end; i += blockStride()) denoise(blockAt(i));
}
