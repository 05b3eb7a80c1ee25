#version 460
// SPDX-License-Identifier: MIT
// Blends the frame into the history. One thread for each pixel.
//
// After Karis, "High Quality Temporal Supersampling" (SIGGRAPH 2014): a filter around the pixel that
// knows the jitter, motion of the nearest surface, and a history that is kept near the colours of
// the frame, here by their variance: Salvi, "An Excursion in Temporal Supersampling" (GDC 2016).
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 jitter;      // pixels: xy of this frame, zw of the previous one
  float frames;     // frames that the history averages
  float width;      // of the colours that the history may have, standard deviations
  float remembers;  // 0: there is no history
  float reacts;     // 1: `reactive` is a mask
} settings;
layout(TEXTURE(0)) uniform sampler2D colour;      // linear light, straight alpha
layout(TEXTURE(1)) uniform sampler2D view_depth;  // metres; 0: sky
layout(TEXTURE(2)) uniform sampler2D motion;
layout(TEXTURE(3)) uniform sampler2D history;     // premultiplied alpha
layout(TEXTURE(4)) uniform sampler2D count_then;  // frames in the history
layout(TEXTURE(5)) uniform sampler2D reactive;    // r: 1: this frame alone counts
layout(IMAGE(0), rgba16f) writeonly uniform image2D result;
layout(IMAGE(1), rgba16f) writeonly uniform image2D history_now;
layout(IMAGE(2), r16f) writeonly uniform image2D count_now;

vec4 colourAt(vec2 at) {
  const vec4 texel = textureLod(colour, at * view.size.zw, 0.0);
  return vec4(texel.rgb * texel.a, texel.a);
}

// Cubic Catmull-Rom filter in five bilinear samples: the corners of its 4x4 texels weigh little.
// After Jimenez, "Filmic SMAA" (SIGGRAPH 2016).
vec4 historyAt(vec2 at) {
  const vec2 centre = floor(at - 0.5) + 0.5, f = at - centre;
  const vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
  const vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f), w2 = 1.0 - w0 - w1 - w3;
  const vec2 w12 = w1 + w2, at12 = centre + w2 / w12;
  const vec2 at0 = centre - 1.0, at3 = centre + 2.0;
  const vec3 places[5] = {vec3(at12, w12.x * w12.y), vec3(at0.x, at12.y, w0.x * w12.y),
                          vec3(at3.x, at12.y, w3.x * w12.y), vec3(at12.x, at0.y, w12.x * w0.y),
                          vec3(at12.x, at3.y, w12.x * w3.y)};
  vec4 sum = vec4(0.0);
  float weight = 0.0;
  for (int i = 0; i < 5; ++i) {
    sum += textureLod(history, places[i].xy * view.size.zw, 0.0) * places[i].z;
    weight += places[i].z;
  }
  return max(sum / weight, 0.0);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  vec4 sum = vec4(0.0), mean = vec4(0.0), square = vec4(0.0);
  float weight = 0.0, nearest = 1e30;
  vec2 front = at;
  for (int i = 0; i < 9; ++i) {
    const vec2 offset = vec2(i % 3, i / 3) - 1.0, place = at + offset;
    const vec4 texel = colourAt(place);
    // The camera shifts the picture by the jitter: this texel shows what lies at offset - jitter.
    // A Gaussian near the Blackman-Harris window of 3.3 pixels.
    const vec2 from = offset - settings.jitter.xy;
    const float share = exp(-2.29 * dot(from, from));
    sum += texel * share, weight += share;
    mean += texel / 9.0, square += texel * texel / 9.0;
    const float depth = textureLod(view_depth, place * view.size.zw, 0.0).x;
    if (depth > 0.0 && depth < nearest) nearest = depth, front = place;
  }
  const vec4 now = sum / weight;
  const vec4 moved = textureLod(motion, front * view.size.zw, 0.0);
  const vec2 then = at + moved.xy + settings.jitter.xy - settings.jitter.zw;
  const bool inside = all(greaterThan(then, vec2(0.0))) && all(lessThan(then, view.size.xy));
  // Where nothing moves that the frame knows of, only the sky keeps its history.
  const bool known = moved.w > 0.0 || nearest > 1e29;
  float count = 0.0;
  if (settings.remembers > 0.0 && inside && known) {
    count = textureLod(count_then, then * view.size.zw, 0.0).x;
  }
  if (settings.reacts > 0.0) {
    count *= 1.0 - clamp(textureLod(reactive, at * view.size.zw, 0.0).x, 0.0, 1.0);
  }
  count = min(count, settings.frames - 1.0);
  vec4 blended = now;
  if (count > 0.0) {
    const vec4 reach = settings.width * sqrt(max(square - mean * mean, 0.0));
    const vec4 before = clamp(historyAt(then), mean - reach, mean + reach);
    blended = mix(before, now, 1.0 / (count + 1.0));
  }
  imageStore(history_now, pixel, blended);
  imageStore(count_now, pixel, vec4(count + 1.0));
  imageStore(result, pixel, vec4(blended.rgb / max(blended.a, 1e-6), blended.a));
}
