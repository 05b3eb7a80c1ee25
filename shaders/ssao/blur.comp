#version 460
// SPDX-License-Identifier: MIT
// Blurs the classic estimator's noise over a square of pixels, and applies finished(). A square of
// 4x4 holds each rotation of the noise tile once. Box: equal weights. Edge-aware: a bilateral
// filter (Tomasi and Manduchi 1998) whose depth weight falls linearly to 0 at a difference of one
// radius.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/view.glsl"
#include "finish.glsl"

layout(constant_id = 0) const uint kSize = 4u;  // width in pixels, at least 2
layout(constant_id = 1) const uint kMode = 0u;  // 0 box, 1 edge-aware

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 finish;   // see finished() in finish.glsl
  float radius;  // metres
} settings;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D raw;  // clamped
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(visibility)))) return;
  const vec2 centre = (vec2(pixel) + 0.5) * view.size.zw;
  const float depth = textureLod(view_depth, centre, 0.0).x;
  float open = 1.0;
  if (depth > 0.0) {
    // An even size has no centre: the square reaches one pixel farther up and left.
    const vec2 corner = centre - float(kSize / 2u) * view.size.zw;
    float sum = 0.0;
    float weights = 0.0;
    [[unroll]] for (uint y = 0u; y < kSize; ++y) {
      [[unroll]] for (uint x = 0u; x < kSize; ++x) {
        const vec2 uv = corner + vec2(x, y) * view.size.zw;
        float weight = 1.0;
        if (kMode == 1u) {
          const float other = textureLod(view_depth, uv, 0.0).x;
          weight = max(0.0, 1.0 - abs(other - depth) / settings.radius);
        }
        sum += weight * textureLod(raw, uv, 0.0).x;
        weights += weight;
      }
    }
    open = sum / weights;
  }
  imageStore(visibility, pixel, finished(vec4(open), settings.finish));
}
