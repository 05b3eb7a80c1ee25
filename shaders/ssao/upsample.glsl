// SPDX-License-Identifier: MIT
// Joint bilateral upsampling (Kopf et al. 2007) of visibility, then finished(). A pixel blends the
// four texels around it: the spatial weight is bilinear, the range weight falls with the
// pixel's distance from the plane of the texel's facet. If none is within the tolerance, the nearest
// wins. BENT is 0 or 1; 1 also upsamples the mean open direction, and turns it into world
// space.
//
// One invocation computes 2x2 pixels between the same four texels: software drivers take as long to
// start an invocation as for ten fetches.
//
// Blocks with pixels that the parameter `refine` selects go on a list, for the passes `refine` and
// `denoise refined`. The latter reads the upsampled pixels around them from the image `blocks`.
#define ORTHOGRAPHIC_ID 7
#include "common/view.glsl"
#include "finish.glsl"
#include "listed.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kScale = 2u;   // pixels per texel, each way: 2 or 4
layout(constant_id = 1) const uint kRefine = 0u;  // the parameter: nothing, edges, contrasts

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 finish;      // see finished() in finish.glsl
  float tolerance;  // inverse of the plane tolerance, 1 / metres
  float contrast;   // the parameter
} settings;
layout(TEXTURE(0)) uniform sampler2D coarse;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform sampler2D view_depth;
layout(TEXTURE(2)) uniform usampler2D tangents;  // of facets, see facet.glsl; nearest, clamped
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;
// With kRefine, a texel for each block: visibilities before finished(), see Block in listed.glsl.
layout(IMAGE(2), r32ui) writeonly uniform uimage2D blocks;
#if BENT
layout(TEXTURE(3)) uniform sampler2D coarse_bent;
layout(TEXTURE(4)) uniform sampler2D world_normal;
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_normal;
// With kRefine. xyz: in view space; w: how much of it the refined direction replaces.
layout(IMAGE(3), rgba16f) writeonly uniform image2D upsampled_bent;
#endif

// Ranges over which a pixel becomes an edge and a contrast: bilinear share of the texels on whose
// planes it lies, and difference of visibility between the four texels over the parameter `contrast`. At a
// limit instead, pixels would change at once when the camera moves, and rounding would decide.
const vec2 kServed = vec2(0.5, 0.3);
const vec2 kContrast = vec2(0.8, 1.2);

// How a pixel blends the four texels around it: `first`, then its neighbours in x, in y and in
// both.
struct Blend {
  vec4 weights;  // sum 1; without a surface, at the pixel or at all texels, all 0
  float served;  // bilinear share of the texels on whose planes it lies, 0 to 1
  float depth;   // of the pixel, metres
};

// The four texels: the pixels that they sample, their view depths, and the planes of their facets in
// tolerances, slopes per pixel.
struct Four {
  vec4 x, y, depth, facing, slope_x, slope_y;
};

// `depth`: view depth of the pixel, metres.
Blend blendOf(ivec2 place, ivec2 first, Four four, float depth) {
  // Texel t is the sample of pixel t * kScale.
  const vec2 fraction = vec2(place - first * int(kScale)) / float(kScale);
  Blend blend = Blend(vec4(0.0), 0.0, depth);
  if (depth <= 0.0) return blend;
  const vec4 x = float(place.x) - four.x, y = float(place.y) - four.y;
  const vec4 off = abs((depth - four.depth) * four.facing +
                       depthScale(depth) * (x * four.slope_x + y * four.slope_y));
  // A texel of the sky is farther than any surface. The cube of 1e12 is still finite.
  const vec4 plane_distance = mix(vec4(1e12), min(off, 1e11), greaterThan(four.depth, vec4(0.0)));
  // A small weight beyond the tolerance, relative to the nearest texel's distance: if no texel is
  // within the tolerance, the nearest dominates, at any distance.
  const float least = min(min(plane_distance.x, plane_distance.y),
                          min(plane_distance.z, plane_distance.w));
  const float tail = 1e-4 * (1.0 + least * least * least);
  const vec4 bilinear = mix(vec4(1.0 - fraction.x), vec4(fraction.x), vec4(0, 1, 0, 1)) *
                        mix(vec4(1.0 - fraction.y), vec4(fraction.y), vec4(0, 0, 1, 1));
  const vec4 on_plane = bilinear * max(1.0 - plane_distance, 0.0);
  blend.served = dot(on_plane, vec4(1.0));
  const vec4 beyond = tail / (1.0 + plane_distance * plane_distance * plane_distance);
  blend.weights = mix(vec4(0.0), on_plane + beyond, greaterThan(four.depth, vec4(0.0)));
  blend.weights /= max(dot(blend.weights, vec4(1.0)), 1e-30);
  return blend;
}

// 0 at the first value of `range`, 1 at the second.
vec4 linearStep(vec2 range, vec4 value) {
  return clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
}

// Difference between the largest and the smallest visibility of the texels that have a surface.
float contrastOf(vec4 open, vec4 depths) {
  const vec4 high = mix(vec4(0.0), open, greaterThan(depths, vec4(0.0)));
  const vec4 low = mix(vec4(1.0), open, greaterThan(depths, vec4(0.0)));
  return max(max(high.x, high.y), max(high.z, high.w)) - min(min(low.x, low.y), min(low.z, low.w));
}

void main() {
  const ivec2 place = ivec2(gl_GlobalInvocationID.xy) * 2;
  const ivec2 size = imageSize(visibility);
  if (any(greaterThanEqual(place, size))) return;
  const ivec2 first = place / int(kScale);
  const vec2 texels = ceil(view.size.xy / float(kScale)), inverse = 1.0 / texels, last = texels - 1.0;
  vec4 open;
  Four four;
#if BENT
  mat4x3 bent;
#endif
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 sampled = min(vec2(first) + vec2(i & 1u, i >> 1u), last);
    const vec2 at = (sampled + 0.5) * inverse, pixel = sampled * float(kScale);
    const vec2 texel = textureLod(coarse, at, 0.0).xy;
    open[i] = texel.x;
    const vec2 tangent = unpackHalf2x16(textureLod(tangents, at, 0.0).x);
    const Plane plane = planeOfTangent(pixel + 0.5, tangent);
    four.x[i] = pixel.x;
    four.y[i] = pixel.y;
    four.depth[i] = texel.y;
    const float tolerance = toleranceAt(texel.y, settings.tolerance, kBetweenTolerance * float(kScale));
    four.facing[i] = plane.facing * tolerance;
    four.slope_x[i] = plane.slope.x * tolerance;
    four.slope_y[i] = plane.slope.y * tolerance;
#if BENT
    bent[i] = textureLod(coarse_bent, at, 0.0).xyz;
#endif
  }
  // A column for each pixel. At half resolution, the first pixel is the one that the first texel
  // sampled and takes its value.
  mat4 weights = mat4(0.0);
  weights[0].x = four.depth.x > 0.0 ? 1.0 : 0.0;
  vec4 served = vec4(1.0), depth = four.depth;
  float own[4];
  [[unroll]] for (uint i = kScale == 2u ? 1u : 0u; i < 4u; ++i) {
    const vec2 at = attachmentAt(vec2(place + ivec2(i & 1u, i >> 1u)) + 0.5);
    own[i] = textureLod(view_depth, at, 0.0).x;
  }
  [[unroll]] for (uint i = kScale == 2u ? 1u : 0u; i < 4u; ++i) {
    const Blend blend = blendOf(place + ivec2(i & 1u, i >> 1u), first, four, own[i]);
    weights[i] = blend.weights;
    served[i] = blend.served;
    depth[i] = blend.depth;
  }
  // A pixel without a surface has no weights: its visibility is 1.
  const vec4 none = vec4(equal(vec4(1.0) * weights, vec4(0.0)));
  const vec4 blended = open * weights + none;
  const vec4 value = finished(blended, settings.finish);
  vec4 share = linearStep(kServed, served);
  if (kRefine >= 2u) {
    const vec4 contrast = vec4(contrastOf(open, four.depth));
    share = max(share, linearStep(settings.contrast * kContrast, contrast));
  }
  const bvec4 inside = bvec4(true, place.x + 1 < size.x, place.y + 1 < size.y,
                             all(lessThan(place + 1, size)));
  // In bytes, so that no refined pixel has a share of 0.
  const uint shares =
      packUnorm4x8(mix(vec4(0.0), share, greaterThan(depth * vec4(inside), vec4(0.0))));
  share = unpackUnorm4x8(shares);
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const ivec2 at = place + ivec2(i & 1u, i >> 1u);
    if (inside[i]) {
      imageStore(visibility, at, vec4(value[i]));
#if BENT
      const vec3 mean = bent * weights[i];
      const vec3 normal = textureLod(world_normal, attachmentAt(vec2(at) + 0.5), 0.0).xyz;
      imageStore(bent_normal, at, vec4(bentNormal(mean, normal), 0.0));
      if (kRefine >= 1u) imageStore(upsampled_bent, at, vec4(mean, share[i]));
#endif
    }
  }
  if (kRefine == 0u) return;
  const Block block = Block(place, packUnorm4x8(clamp(blended, 0.0, 1.0)), shares);
  imageStore(blocks, place / 2, uvec4(block.open));
  if (block.shares != 0u) append(block);
}
