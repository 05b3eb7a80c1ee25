#version 460
// SPDX-License-Identifier: MIT
// Upsamples the traced visibility and blends it into the history. One thread for each pixel.
#extension GL_GOOGLE_include_directive : require
#include "settings.glsl"

layout(TEXTURE(0)) uniform sampler2D view_depth;  // metres; 0: sky
layout(TEXTURE(1)) uniform sampler2D traced;      // half size: visibility, view depth
layout(TEXTURE(2)) uniform sampler2D motion;
layout(TEXTURE(3)) uniform sampler2D history;  // visibility, frames, view depth
layout(TEXTURE(4)) uniform sampler2D ao;
layout(IMAGE(0), r16f) writeonly uniform image2D visibility;
layout(IMAGE(1), rgba16f) writeonly uniform image2D history_now;

// Share of the view depth by which one surface may differ.
const float kSame = 0.05;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  const float depth = textureLod(view_depth, at * view.size.zw, 0.0).x;
  // The blocks within 2 pixels, by distance in the picture and in depth: a joint bilateral filter
  // (Kopf et al. 2007).
  const ivec2 last = textureSize(traced, 0) - 1;
  float light = 0.0, weight = 0.0;
  for (int i = 0; i < 9; ++i) {
    const ivec2 block = clamp(pixel / 2 + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
    const vec2 texel = texelFetch(traced, block, 0).xy;
    const vec2 away = at - (2.0 * vec2(block) + 1.0);
    const float near = exp(-0.25 * dot(away, away));
    const float share = near * max(1.0 - abs(texel.y - depth) / (kSame * depth + 1e-6), 1e-4);
    light += texel.x * share, weight += share;
  }
  light /= weight;
  float count = 0.0;
  if (depth > 0.0 && settings.remembers != 0u) {
    const vec4 moved = textureLod(motion, at * view.size.zw, 0.0);
    const vec2 then = (at + moved.xy) * view.size.zw;
    const vec4 before = textureLod(history, then, 0.0);
    const bool inside = all(greaterThan(then, vec2(0.0))) && all(lessThan(then, vec2(1.0)));
    const float expected = depth * (1.0 + moved.z);
    if (moved.w > 0.0 && inside && abs(before.z - expected) < kSame * expected) {
      count = min(before.y, settings.frames - 1.0);
      light = mix(before.x, light, 1.0 / (count + 1.0));
    }
  }
  imageStore(history_now, pixel, vec4(light, count + 1.0, depth, 0.0));
  if (depth <= 0.0) light = 1.0;
  float open = 1.0 - settings.strength * (1.0 - light);
  // Ambient occlusion multiplies the light too, and knows the same near surfaces: the darker of both
  // counts, not their product.
  if (settings.has_ao != 0u) {
    const float other = textureLod(ao, at * view.size.zw, 0.0).x;
    open = other > 1e-3 ? min(open, other) / other : 1.0;
  }
  imageStore(visibility, pixel, vec4(clamp(open, 0.0, 1.0)));
}
