// SPDX-License-Identifier: MIT
// A shot's splat: its paint appears where its strength is above its noise. The noise has lobes, which
// point away from the shot's ray, and drops. It lies in the plane across the ray, so that a splat is
// longer where the ray grazes a surface. Every shot has a seed of its own. effects/sspm/README.md
// has the definition (steps 3 to 5).
#include "place.glsl"

const uint kOctaves = 2;
const float kNextOctave = 0.35;  // weight of an octave of lobes: share of the one before
const float kAlong = 0.4;        // cells of lobes along the way from the ray, per splat_scale
const float kDropCells = 1.6;    // width of the cells of drops, per splat_scale

layout(UNIFORM(1), std140) uniform Splat {
  float cells;        // of the first octave's lobes, per metre
  float half_width;   // half the width of the smooth step, in strength; 0: a hard edge
  uint octaves;       // kOctaves, but unknown to the compiler, which then keeps the loop
  uint seed;
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
// Perlin 2002, "Improving Noise". place: in cells.
float valueNoise(vec2 place, uint seed) {
  const vec2 whole = floor(place);
  const vec2 f = place - whole;
  const vec2 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const uvec2 low = uvec2(ivec2(whole)) * uvec2(0x9e3779b1u, 0x85ebca77u);
  const uvec2 high = low + uvec2(0x9e3779b1u, 0x85ebca77u);
  const uvec4 bits = uvec4(low.x, high.x, low.x, high.x) ^ uvec4(low.y, low.y, high.y, high.y) ^ seed;
  const vec4 at = vec4(hashBits(bits.x) >> 8, hashBits(bits.y) >> 8, hashBits(bits.z) >> 8, hashBits(bits.w) >> 8);
  const vec2 x = mix(at.xz, at.yw, w.x);
  return mix(x.x, x.y, w.y) * (1.0 / 16777216.0);
}

// Two axes across a unit direction (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
mat2x3 axesAcross(vec3 w) {
  const float s = w.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + w.z);
  const float b = w.x * w.y * a;
  return mat2x3(1.0 + s * w.x * w.x * a, s * b, -s * w.x, b, s + w.y * w.y * a, -w.y);
}

// The seed of a shot's splat. fraction: the muzzle's position less its whole metres.
uint splatSeed(vec3 fraction, vec3 direction) {
  const uvec3 a = floatBitsToUint(fraction) * uvec3(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du);
  const uvec3 b = floatBitsToUint(direction) * uvec3(0x165667b1u, 0xd3a2646du, 0xfd7046c5u);
  return hashBits(splat.seed * 0x27d4eb2fu ^ a.x ^ a.y ^ a.z ^ b.x ^ b.y ^ b.z);
}

// A drop in each cell of a lattice: 0 at its centre, 1 at its border, more beyond. place: in cells.
float dropNoise(vec2 place, uint seed) {
  const vec2 whole = floor(place);
  const uvec2 cell = uvec2(ivec2(whole)) * uvec2(0x9e3779b1u, 0x85ebca77u);
  const uint bits = hashBits(cell.x ^ cell.y ^ seed ^ 0x51ed270bu);
  // Most drops are small. All lie inside their cells.
  const float size = float(bits & 255u) * (1.0 / 256.0);
  const float radius = 0.06 + 0.34 * size * size;
  const vec2 part = vec2(bits >> 8 & 4095u, bits >> 20) * (1.0 / 4096.0);
  const vec2 apart = (place - whole - mix(vec2(radius), vec2(1.0 - radius), part)) / radius;
  return dot(apart, apart);
}

// Noise in [0, 0.9]: full strength is always paint. An octave of lobes whose cells are less than four
// pixels wide fades to its mean; at two pixels it is gone. Drops fade from eight pixels to four.
// across: offset from the shot's ray, along axesAcross(), metres. pixel: a pixel's width there,
// metres. middle: distance of the rim's middle from the ray, metres. octaves: number of octaves; 0
// gives the mean.
float splatNoise(uint seed, vec2 across, float pixel, float middle, uint octaves) {
  // A turn by up to 90 degrees, which differs from shot to shot, and by 37 between octaves.
  const float t = float(hashBits(seed ^ 0x68bc21ebu) >> 8) * (1.0 / 16777216.0);
  const vec2 turn = vec2(1.0 - t * t, 2.0 * t) / (1.0 + t * t);
  const vec2 turned = vec2(turn.x * across.x - turn.y * across.y, turn.y * across.x + turn.x * across.y);
  // The lattice of lobes is drawn out along the way from the ray, 2.5 times at the rim.
  const float outward = kAlong + (1.0 - kAlong) * middle / max(length(across), 1e-6);
  vec2 lobes = turned * (splat.cells * outward), drops = turned * (splat.cells / kDropCells);
  float sum = 0.0, weight = 1.0, cells = splat.cells, drop = 1.0;
  for (uint octave = 0u; octave < octaves; ++octave) {
    const uint of = seed + octave * 0x27d4eb2fu;
    const float shown = clamp(0.5 / (pixel * cells * outward) - 1.0, 0.0, 1.0);
    sum += weight * shown * (valueNoise(clamp(lobes, -1e9, 1e9), of) - 0.5);
    const float visible = clamp(0.25 * kDropCells / (pixel * cells) - 1.0, 0.0, 1.0);
    drop = min(drop, mix(1.0, dropNoise(clamp(drops, -1e9, 1e9), of), visible));
    weight *= kNextOctave;
    cells *= 2.0;
    lobes = vec2(1.6 * lobes.x - 1.2 * lobes.y, 1.2 * lobes.x + 1.6 * lobes.y);
    drops = vec2(1.6 * drops.x - 1.2 * drops.y, 1.2 * drops.x + 1.6 * drops.y);
  }
  // The sum of octaves stays near its mean: a factor makes it fill the range.
  const float lobe = smoothstep(0.0, 1.0, 0.5 + 1.7 / (1.0 + kNextOctave) * sum);
  return 0.9 * min(mix(0.2, 1.0, lobe), drop);
}

// Alpha of paint of this strength: 0 or 1, and between them over the width of the smooth step.
float splatAlpha(float strength, float noise) {
  if (strength <= 0.0) return 0.0;
  const float above = strength - noise;
  if (splat.half_width <= 0.0) return above > 0.0 ? 1.0 : 0.0;
  return smoothstep(-splat.half_width, splat.half_width, above) * min(strength / splat.half_width, 1.0);
}

// What lies on a point, composited newest first.
struct Sum {
  vec3 color;      // of the shots, times the alpha that each adds
  float alpha;     // largest of the shots' alphas
  float strengths; // sum
  float weight;    // alpha that the owner adds
  float before;    // strengths of the shots newer than the owner
  uint owner;      // the shot that adds most alpha; 0: no paint
};
const Sum kNothing = Sum(vec3(0.0), 0.0, 0.0, 0.0, 0.0, 0u);

// Whether older shots can still change the outputs: early ray termination.
// covered: the sum of strengths matters too, up to 1.
bool isOpen(Sum sum, bool covered) {
  return sum.strengths < 1.0 && (covered || sum.alpha < 1.0);
}

// Composites one shot below the sum, by steps 3 to 5 of the definition.
// across: offset from its ray, along axesAcross(), metres. pixel: a pixel's width, metres.
// seed: of its splat. times: number of shots that this one stands for. owner: what names the shot.
void composite(inout Sum sum, vec2 across, float pixel, uint seed, float range, float full,
               float per_fade, float times, vec3 color, uint owner) {
  const float apart = length(across);
  const float alpha = min(1.0, full / max(apart, 1e-6));
  const float fade = clamp((1.0 - apart / range) * per_fade, 0.0, 1.0);
  const float strength = min(times * alpha * fade, 1.0);
  sum.strengths += strength;
  // Several weak shots together close gaps.
  const float filled = clamp(1.0 - 4.0 * (1.0 - sum.strengths), strength, 1.0);
  // Near full strength the noise decides nothing, and the shader skips its octaves.
  const bool open = filled < 0.9 + splat.half_width;
  const float middle = range * (1.0 - 0.5 / per_fade);
  const float noise = splatNoise(seed, across, pixel, middle, open ? splat.octaves : 0u);
  const float shown = splatAlpha(filled, noise);
  const float weight = max(shown - sum.alpha, 0.0);
  sum.color += weight * color;
  sum.alpha = max(sum.alpha, shown);
  if (weight > sum.weight) {
    sum.weight = weight;
    sum.before = sum.strengths - strength;
    sum.owner = owner;
  }
}
