// SPDX-License-Identifier: MIT
// A pixel's visibility from the four texels about it: bilinear, less what lies off the plane of the
// pixel's surface. Where none lies in it, the nearest to it. Then intensity and power. With BENT,
// which is 0 or 1, the mean open direction as well, turned to the world.
//
// One invocation does 2x2 pixels, which lie between the same four texels: software drivers take as
// long to start an invocation as for ten fetches.
#include "common/view.glsl"
#include "finish.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel, each way: 2 or 4

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 finish;
  float tolerance;  // 1 / metres
} settings;
layout(TEXTURE(0)) uniform sampler2D coarse;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform sampler2D view_depth;
layout(TEXTURE(2)) uniform sampler2D world_normal;
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;
#if BENT
layout(TEXTURE(3)) uniform sampler2D coarse_bent;
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_normal;
#endif

// The weights of four texels, at `first` and one on in x, in y, and in both, of which `depths` are
// the view depths. All 0: there is no surface.
vec4 weightsAt(ivec2 place, ivec2 first, vec4 depths) {
  const vec2 pixel = vec2(place) + 0.5;
  const float depth = textureLod(view_depth, attachmentAt(pixel), 0.0).x;
  const vec3 normal = viewNormal(textureLod(world_normal, attachmentAt(pixel), 0.0).xyz);
  const Plane plane = planeOf(pixel, normal);
  // Texel t is the sample of pixel t * kScale.
  const vec2 part = vec2(place - first * int(kScale)) / float(kScale);
  vec4 weights = vec4(0.0);
  if (depth <= 0.0) return weights;
  const float tolerance = toleranceAt(depth, settings.tolerance);
  vec4 off;
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 across = (vec2(i & 1u, i >> 1u) - part) * float(kScale);
    off[i] = offPlane(plane, depth, depths[i], across);
    // No texel: as far off as none can be, whose cube is still a number.
    off[i] = depths[i] > 0.0 ? min(off[i] * tolerance, 1e11) : 1e12;
  }
  // Past the tolerance what is left makes the nearest win where none is within it, however far off
  // that is.
  const float least = min(min(off.x, off.y), min(off.z, off.w));
  const float left = 1e-4 * (1.0 + least * least * least);
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 share = mix(1.0 - part, part, vec2(i & 1u, i >> 1u));
    weights[i] = depths[i] > 0.0 ? share.x * share.y * max(0.0, 1.0 - off[i]) +
                                       left / (1.0 + off[i] * off[i] * off[i])
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
  // A column for each pixel. At half resolution the first pixel is the first texel's own.
  mat4 weights = mat4(0.0);
  weights[0].x = depths.x > 0.0 ? 1.0 : 0.0;
  [[unroll]] for (uint i = kScale == 2u ? 1u : 0u; i < 4u; ++i) {
    weights[i] = weightsAt(place + ivec2(i & 1u, i >> 1u), first, depths);
  }
  // Nothing shuts what has no surface, and no weights.
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
