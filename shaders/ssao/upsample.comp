#version 460
// SPDX-License-Identifier: MIT
// A pixel's visibility from the four texels about it: bilinear, less what lies off the plane of the
// pixel's surface. Where none lies in it, the nearest to it. Then intensity and power.
//
// One invocation does 2x2 pixels, which lie between the same four texels: software drivers take as
// long to start an invocation as for ten fetches.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/view.glsl"
#include "finish.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel, each way: 2 or 4

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  float tolerance;  // 1 / metres
  float intensity;
  float power;
} settings;
layout(TEXTURE(0)) uniform sampler2D coarse;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform sampler2D view_depth;
layout(TEXTURE(2)) uniform sampler2D world_normal;
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;

// texels: those at `first` and one on in x, in y, and in both.
float openAt(ivec2 place, ivec2 first, vec2 texels[4]) {
  const vec2 pixel = vec2(place) + 0.5;
  const float depth = textureLod(view_depth, pixel * view.size.zw, 0.0).x;
  const vec3 normal = viewNormal(textureLod(world_normal, pixel * view.size.zw, 0.0).xyz);
  const vec4 plane = planeOf(pixel, depth, normal) * settings.tolerance;
  // Texel t is the sample of pixel t * kScale.
  const vec2 part = vec2(place - first * int(kScale)) / float(kScale);
  float sum = 0.0, weights = 0.0;
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 corner = vec2(i & 1u, i >> 1u);
    const float off =
        distanceFrom(plane, (vec2(first) + corner) * float(kScale) + 0.5, texels[i].y);
    const vec2 share = mix(1.0 - part, part, corner);
    // Past the tolerance what is left makes the nearest win where none is within it.
    const float weight = texels[i].y > 0.0 ? share.x * share.y * max(0.0, 1.0 - off) +
                                                 1e-4 / (1.0 + off * off * off)
                                           : 0.0;
    sum += weight * texels[i].x;
    weights += weight;
  }
  return depth > 0.0 && weights > 0.0 ? sum / weights : 1.0;
}

void main() {
  const ivec2 place = ivec2(gl_GlobalInvocationID.xy) * 2;
  const ivec2 size = imageSize(visibility);
  if (any(greaterThanEqual(place, size))) return;
  const ivec2 first = place / int(kScale);
  const vec2 inverse = 1.0 / ceil(view.size.xy / float(kScale));
  vec2 texels[4];
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 at = vec2(first) + vec2(i & 1u, i >> 1u) + 0.5;
    texels[i] = textureLod(coarse, at * inverse, 0.0).xy;
  }
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const ivec2 at = place + ivec2(i & 1u, i >> 1u);
    const float open =
        finished(openAt(at, first, texels), settings.intensity, settings.power);
    if (all(lessThan(at, size))) imageStore(visibility, at, vec4(open));
  }
}
