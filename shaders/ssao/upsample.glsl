// SPDX-License-Identifier: MIT
// Joint bilateral upsampling (Kopf et al. 2007) of visibility, then finished(). A pixel blends the
// four texels around it: the spatial weight is bilinear, the range weight falls with a texel's
// distance from the pixel's tangent plane. If no texel is within the tolerance, the nearest to the
// plane wins. BENT is 0 or 1; 1 also upsamples the mean open direction, and turns it into world
// space.
//
// One invocation computes 2x2 pixels between the same four texels: software drivers take as long to
// start an invocation as for ten fetches.
#include "common/view.glsl"
#include "finish.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kScale = 2u;  // pixels per texel, each way: 2 or 4

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 finish;      // see finished() in finish.glsl
  float tolerance;  // inverse of the plane tolerance, 1 / metres
} settings;
layout(TEXTURE(0)) uniform sampler2D coarse;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform sampler2D view_depth;
layout(TEXTURE(2)) uniform sampler2D world_normal;
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;
#if BENT
layout(TEXTURE(3)) uniform sampler2D coarse_bent;
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_normal;
#endif

// Weights of the four texels around a pixel, with a sum of 1: `first`, then its neighbours in x, in
// y and in both. `depths` holds their view depths. Without a surface, at the pixel or at all
// texels, all weights are 0.
vec4 bilateralWeights(ivec2 place, ivec2 first, vec4 depths) {
  const vec2 pixel = vec2(place) + 0.5;
  const float depth = textureLod(view_depth, attachmentAt(pixel), 0.0).x;
  const vec3 normal = viewNormal(textureLod(world_normal, attachmentAt(pixel), 0.0).xyz);
  const Plane plane = planeOf(pixel, normal);
  // Texel t is the sample of pixel t * kScale.
  const vec2 fraction = vec2(place - first * int(kScale)) / float(kScale);
  vec4 weights = vec4(0.0);
  if (depth <= 0.0) return weights;
  const float tolerance = toleranceAt(depth, settings.tolerance);
  vec4 plane_distance;  // in tolerances
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 across = (vec2(i & 1u, i >> 1u) - fraction) * float(kScale);
    plane_distance[i] = planeDistance(plane, depth, depths[i], across);
    // A texel of the sky is farther than any surface. The cube of 1e12 is still finite.
    plane_distance[i] = depths[i] > 0.0 ? min(plane_distance[i] * tolerance, 1e11) : 1e12;
  }
  // A small weight beyond the tolerance, relative to the nearest texel's distance: if no texel is
  // within the tolerance, the nearest dominates, at any distance.
  const float least = min(min(plane_distance.x, plane_distance.y),
                          min(plane_distance.z, plane_distance.w));
  const float tail = 1e-4 * (1.0 + least * least * least);
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 bilinear = mix(1.0 - fraction, fraction, vec2(i & 1u, i >> 1u));
    weights[i] =
        depths[i] > 0.0
            ? bilinear.x * bilinear.y * max(0.0, 1.0 - plane_distance[i]) +
                  tail / (1.0 + plane_distance[i] * plane_distance[i] * plane_distance[i])
            : 0.0;
  }
  return weights / max(dot(weights, vec4(1.0)), 1e-30);
}

void main() {
  const ivec2 place = ivec2(gl_GlobalInvocationID.xy) * 2;
  const ivec2 size = imageSize(visibility);
  if (any(greaterThanEqual(place, size))) return;
  const ivec2 first = place / int(kScale);
  const vec2 inverse = 1.0 / ceil(view.size.xy / float(kScale));
  vec4 open, depths;
#if BENT
  mat4x3 bent;
#endif
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 at = (vec2(first) + vec2(i & 1u, i >> 1u) + 0.5) * inverse;
    const vec2 texel = textureLod(coarse, at, 0.0).xy;
    open[i] = texel.x;
    depths[i] = texel.y;
#if BENT
    bent[i] = textureLod(coarse_bent, at, 0.0).xyz;
#endif
  }
  // A column for each pixel. At half resolution, the first pixel is the one that the first texel
  // sampled and takes its value.
  mat4 weights = mat4(0.0);
  weights[0].x = depths.x > 0.0 ? 1.0 : 0.0;
  [[unroll]] for (uint i = kScale == 2u ? 1u : 0u; i < 4u; ++i) {
    weights[i] = bilateralWeights(place + ivec2(i & 1u, i >> 1u), first, depths);
  }
  // A pixel without a surface has no weights: its visibility is 1.
  const vec4 none = vec4(equal(vec4(1.0) * weights, vec4(0.0)));
  const vec4 value = finished(open * weights + none, settings.finish);
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const ivec2 at = place + ivec2(i & 1u, i >> 1u);
    if (all(lessThan(at, size))) {
      imageStore(visibility, at, vec4(value[i]));
#if BENT
      const vec3 normal = textureLod(world_normal, attachmentAt(vec2(at) + 0.5), 0.0).xyz;
      imageStore(bent_normal, at, vec4(bentNormal(bent * weights[i], normal), 0.0));
#endif
    }
  }
}
