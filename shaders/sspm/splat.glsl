// SPDX-License-Identifier: MIT
// The splat step: paint appears where its coverage is above a noise of the world position. The
// noise is a sum of three octaves of value noise, on lattices of splat_scale / 2^octave metres that
// are fixed in the world. The hash takes a lattice point as integers. effects/sspm/README.md has
// the definition (step 4).
#include "place.glsl"

const uint kOctaves = 3;

layout(UNIFORM(1), std140) uniform Splat {
  // One per octave. xyz: the camera's lattice cell, modulo 2^32; w: hash seed.
  ivec4 noise_cell[kOctaves];
  // xyz: the camera's position in its cell, in cells; w: cells per metre.
  vec4 noise_fraction[kOctaves];
  float half_width;   // half the width of the smooth step, in coverage; 0: a hard edge
  uint octaves;       // kOctaves, but unknown to the compiler, which then keeps the loop
} splat;

// Integer hash lowbias32 (Wellons 2018, "Prospecting for Hash Functions").
uint hashBits(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

// Value noise: uniform in [0, 1) at the lattice points, between them the quintic interpolation of
// Perlin 2002, "Improving Noise". `place` is in cells from `origin`, which may wrap around.
float valueNoise(ivec3 origin, vec3 place, uint seed) {
  const vec3 whole = floor(place);
  const vec3 f = place - whole;
  const vec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const uvec3 low = uvec3(origin + ivec3(whole));
  const uvec3 a = low * uvec3(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du);
  const uvec3 b = (low + 1u) * uvec3(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du);
  vec4 x0 = vec4(0.0), x1 = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    const uint yz = ((i & 1) != 0 ? b.y : a.y) ^ ((i & 2) != 0 ? b.z : a.z) ^ seed;
    x0[i] = float(hashBits(a.x ^ yz) >> 8);
    x1[i] = float(hashBits(b.x ^ yz) >> 8);
  }
  const vec4 x = mix(x0, x1, w.x);
  const vec2 y = mix(x.xz, x.yw, w.y);
  return mix(y.x, y.y, w.z) * (1.0 / 16777216.0);
}

// Noise in [0, 0.9]: full coverage is always paint. An octave whose cells are less than four pixels
// wide fades to its mean; at two pixels it is gone.
// from_camera: position relative to the camera, world axes, metres.
// octaves: number of octaves; 0 gives the mean.
float splatNoise(vec3 from_camera, float view_depth, uint octaves) {
  float sum = 0.0, weights = 0.0;
  const float pixel = pixelSize(view_depth);
  for (uint octave = 0; octave < octaves; ++octave) {
    const float cells = splat.noise_fraction[octave].w;
    const float weight = exp2(-float(octave));
    const float shown = clamp(1.0 / (2.0 * pixel * cells) - 1.0, 0.0, 1.0);
    if (shown > 0.0) {
      const vec3 place = from_camera * cells + splat.noise_fraction[octave].xyz;
      const float value =
          valueNoise(splat.noise_cell[octave].xyz, place, uint(splat.noise_cell[octave].w));
      sum += weight * shown * (value - 0.5);
    }
    weights += weight;
  }
  // The sum of octaves stays near its mean: a factor of 2 makes it fill the range.
  return 0.9 * clamp(0.5 + 2.0 * sum / max(weights, 1.0), 0.0, 1.0);
}

// Alpha of paint with this coverage: 0 or 1, and between them over the width of the smooth step.
float splatAlpha(float coverage, float noise) {
  if (coverage <= 0.0) return 0.0;
  const float above = coverage - noise;
  if (splat.half_width <= 0.0) return above > 0.0 ? 1.0 : 0.0;
  return smoothstep(-splat.half_width, splat.half_width, above) * min(coverage / splat.half_width, 1.0);
}
