#version 460
// SPDX-License-Identifier: MIT
// Gathers the discs that cover each pixel. One thread for each pixel.
//
// Scatter as gather, with what lies in front of the pixel's surface as a layer of its own: after
// Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare" (SIGGRAPH 2014).
#extension GL_GOOGLE_include_directive : require
#include "lens.glsl"

layout(TEXTURE(0)) uniform sampler2D colour;  // linear light, straight alpha
layout(TEXTURE(1)) uniform sampler2D radius;
layout(TEXTURE(2)) uniform sampler2D tiles;
layout(IMAGE(0), rgba16f) writeonly uniform image2D blurred;
shared uint most;

const float kSharp = 0.5;         // a smaller disc lies inside its pixel, pixels
const float kGoldenAngle = 2.39996323;

vec4 premultiplied(vec2 at) {
  const vec4 texel = textureLod(colour, at * view.size.zw, 0.0);
  return vec4(texel.rgb * texel.a, texel.a);
}

// Light per area of a disc relative to that of a pixel's width times pi.
float density(float disc) {
  const float wide = max(disc, kSharp);
  return 1.0 / (wide * wide);
}

void main() {
  // No disc reaches further than the largest of the tiles within `largest`.
  if (gl_LocalInvocationIndex == 0) most = 0;
  barrier();
  const int around = int(ceil(lens.largest / float(kTile)));
  const int side = 2 * around + 1;
  const ivec2 count = textureSize(tiles, 0);
  for (int i = int(gl_LocalInvocationIndex); i < side * side; i += int(kTile * kTile)) {
    const ivec2 tile = ivec2(gl_WorkGroupID.xy) + ivec2(i % side, i / side) - around;
    const vec2 at = (vec2(clamp(tile, ivec2(0), count - 1)) + 0.5) / vec2(count);
    atomicMax(most, floatBitsToUint(textureLod(tiles, at, 0.0).x));
  }
  barrier();
  const float reach = uintBitsToFloat(most);
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  const vec2 centre = vec2(pixel) + 0.5;
  if (reach < kSharp) {
    imageStore(blurred, pixel, textureLod(colour, centre * view.size.zw, 0.0));
    return;
  }
  const float own = textureLod(radius, centre * view.size.zw, 0.0).x;
  const int samples = int(lens.samples);
  const float area = reach * reach / float(samples);  // of a sample, over pi
  // The pixel itself covers an area of 1.
  float weight = density(abs(own)) / 3.14159265;
  vec4 behind = premultiplied(centre) * weight, front = vec4(0.0);
  float covered = 0.0;
  for (int i = 0; i < samples; ++i) {
    // A spiral of equal areas (Vogel 1979).
    const float from = reach * sqrt((float(i) + 0.5) / float(samples));
    const float angle = float(i) * kGoldenAngle;
    const vec2 at = centre + from * vec2(cos(angle), sin(angle));
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, view.size.xy))) continue;
    const float other = textureLod(radius, at * view.size.zw, 0.0).x;
    const vec4 light = premultiplied(at);
    const float nearer = clamp(own - other, 0.0, 1.0);
    // The disc of a surface behind does not reach over the edge of a sharper one.
    const float disc = mix(min(abs(other), max(abs(own), kSharp)), abs(other), nearer);
    const float share = area * density(disc) * clamp(disc - from + 0.5, 0.0, 1.0);
    front += light * share * nearer;
    covered += share * nearer;
    behind += light * share * (1.0 - nearer);
    weight += share * (1.0 - nearer);
  }
  const vec4 sum = mix(behind / weight, front / max(covered, 1e-6), min(covered, 1.0));
  imageStore(blurred, pixel, vec4(sum.rgb / max(sum.a, 1e-6), sum.a));
}
