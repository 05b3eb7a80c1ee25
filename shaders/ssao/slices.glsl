// SPDX-License-Identifier: MIT
// Ambient visibility by slices through the view vector and a bitmask of occluded sectors: Therrien,
// Levesque and Gilet 2023, "Screen Space Indirect Lighting with Visibility Bitmask", on the slices
// of Jimenez et al. 2016, "Practical Real-Time Strategies for Accurate Indirect Occlusion".
//
// Line numbers refer to Algorithm 1 of either paper; for Jimenez 2016, of Technical Memo
// ATVI-TR-19-01.
//
// - A slice is the plane through the view vector and a direction, which the shader draws with
//   cosine density about the normal. All slices then have the same weight. Angles in a slice start
//   at the view vector and are negative on one side.
// - A sector is a 32nd of the slice's cosine-weighted solid angle. The share of clear bits is
//   therefore the slice's visibility.
// - A tap finds a surface in the depth buffer, and assumes solid matter of `thickness` behind it.
//   The sphere of the radius cuts this solid off; it has no falloff.
//
// A texel of the target samples one of kScale x kScale pixels, the top left one. At edges, where
// the denoiser finds few texels of one surface, the texel takes kEdgeSlices times as many slices.
// BENT is 0 or 1; 1 also computes the mean open direction. LISTED is 0 or 1; 1 computes only
// pixels of listed blocks (listed.glsl), at the picture's resolution, none of them as an edge. They
// take twice the slices.
#define ORTHOGRAPHIC_ID 7
#include "common/view.glsl"
#include "plane.glsl"
#if LISTED
#include "listed.glsl"
#endif

layout(constant_id = 0) const uint kSlices = 1u;
layout(constant_id = 1) const uint kSteps = 8u;  // taps on each side of a slice
layout(constant_id = 2) const uint kScale = 1u;  // pixels per texel, each way
// Where matter ends: 0 after `thickness`, 1 after the thickness in `known`, 2 at the depth in `known`.
// 3 is 2 with a second solid, which begins at `next_depth`.
layout(constant_id = 3) const uint kBacks = 0u;
#if !LISTED
layout(constant_id = 4) const uint kEdgeSlices = 1u;  // factor on the slices at edges
#endif

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  float radius;     // metres
  float thickness;  // assumed behind a surface whose back is unknown, metres
  float turn;       // rotation of the slice pattern, 0 to 1
  float tolerance;  // inverse of the plane tolerance, 1 / metres
  uvec2 exchange;   // offset of the texel in the 5x5 pattern, 0 to 4
  float bias;       // metres
} settings;
layout(TEXTURE(0)) uniform sampler2D view_depth;  // nearest, clamped
layout(TEXTURE(1)) uniform sampler2D world_normal;
layout(TEXTURE(2)) uniform sampler2D known;  // with kBacks, metres; nearest, clamped
layout(TEXTURE(3)) uniform sampler2D next_depth;  // with kBacks = 3, metres; nearest, clamped
#if LISTED
layout(IMAGE(0), r32ui) writeonly uniform uimage2D blocks;  // see upsample.glsl
#else
layout(IMAGE(0), rg32f) writeonly uniform image2D target;  // visibility and view depth
layout(IMAGE(2), r32ui) writeonly uniform uimage2D tangents;  // of facets, see facet.glsl
#include "facet.glsl"
#endif
#if BENT
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_target;  // in view space, any length
#endif

const float kPi = 3.14159265358979;

// Error at most 7e-5 radians: Hastings 1955, "Approximations for Digital Computers", sheet 38; x in
// [0, 1].
float arcCosine(float x) {
  return sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - 0.0187293 * x)));
}

#include "sectors.glsl"

// Pixel of the tap at a distance of `pixels` along `way`. Distant taps snap to a grid, whose cells
// are an eighth to a sixteenth of the distance wide: neighbouring pixels then read the same texels,
// which stay in the cache, and their results differ less. With more than 16 steps the grid is
// finer, so that no two taps fall on one pixel.
vec2 tapAt(vec2 pixel, vec2 way, float pixels) {
  const float finer = float(max(8u, (1u << uint(findMSB(kSteps - 1u) + 1)) / 2u));
  const uint below = floatBitsToUint(pixels) & 0x7f800000u;  // a power of two
  const float inverse = min(finer * uintBitsToFloat(0x7f000000u - below), 1.0);
  const float grid = max(uintBitsToFloat(below) * (1.0 / finer), 1.0);
  return floor((pixel + way * pixels - 0.5) * inverse + 0.5) * grid + 0.5;
}

// Visibility of one slice. Adds the slice's mean open direction to `bent`.
float sliceOf(vec3 position, vec3 view_vec, vec3 normal, vec3 direction, vec2 pixel, float jitter,
              inout vec3 bent) {
  vec3 ortho_direction = direction - view_vec * dot(direction, view_vec);
  ortho_direction *= inversesqrt(max(dot(ortho_direction, ortho_direction), 1e-12));
  vec2 at = vec2(dot(normal, ortho_direction), dot(normal, view_vec));
  const float inverse_length = inversesqrt(max(dot(at, at), 1e-4));
  at *= inversesqrt(max(dot(at, at), 1e-12));
  // Frame of the slice, and angle n of the projected normal (Jimenez 2016, lines 9 to 15).
  Slice s;
  s.pixel = pixel;
  s.depth = -position.z;
  s.ray = rayDirection(pixel);
  s.along = ortho_direction * at.y - view_vec * at.x;
  s.up = normal * inverse_length;
  s.cos_n = at.y;
  s.sin_n = at.x;
  // The integral over the whole slice is cos n + n sin n; below the view vector it is half of
  // cos n + (n - pi/2) sin n.
  const float angle = arcCosine(min(abs(at.y), 1.0));
  const float n = sign(at.x) * (at.y < 0.0 ? kPi - angle : angle);
  s.scale = 0.5 / (s.cos_n + n * s.sin_n);
  s.offset = (s.cos_n + (n - 0.5 * kPi) * s.sin_n) * s.scale;

  // Direction of the slice on the screen, and extent of the sphere along it in pixels: up to the
  // view ray that is tangent to the sphere.
  const float scale = depthScale(-position.z);
  vec2 way = (ortho_direction.xy * scale + position.xy * (ortho_direction.z * perspective())) *
             view.pixel_from_view.xy;
  const float stretch = dot(way, way);
  way *= inversesqrt(max(stretch, 1e-20));
  const float near = perspective() * settings.radius * settings.radius / dot(position, position);
  const float reach = settings.radius / (scale * scale) * sqrt(stretch / max(1.0 - near, 0.0625));
  uint occluded = 0u;
  // With thicknesses, the first tap may belong to the pixel's own surface. With drawn backs that has a
  // larger error on leaves.
  const float own = kBacks < 2u ? -position.z : -1e30, centre = -settings.radius * settings.radius;
  const vec2 none = vec2(0.0);
  Taps taps = Taps(none, none, none, none, vec2(1.0, 0.0), vec2(own), vec2(centre), vec2(1.0), none,
                   none, none);
  Taps next_taps = taps;
  // Not unrolled: unrolling costs a third more on lavapipe and gains nothing elsewhere.
  for (uint i = 0u; i < kSteps; ++i) {
    // Taps are denser near the pixel. Tap i is at least i + 1 pixels away.
    const float one = (float(i) + jitter) / float(kSteps);
    const float two = (float(i) + 1.0 - jitter) / float(kSteps);
    const float least = float(i) + 1.0;
    const float to = max(one * sqrt(one) * reach, least);
    const float back = max(two * sqrt(two) * reach, least);
    const vec4 at = vec4(tapAt(pixel, way, to), tapAt(pixel, -way, back));
    occluded |= sectorsOfTaps(s, solidsAt(s, at, false), jitter, false, taps);
    if (kBacks == 3u) {
      occluded |= sectorsOfTaps(s, solidsAt(s, at, true), jitter, true, next_taps);
    }
  }
  occluded |= sectorsBeyond(s, taps, jitter);
#if BENT
  bent += meanOpen(s, n, ortho_direction, view_vec, occluded);
#endif
  return 1.0 - float(bitCount(occluded)) / 32.0;  // share of clear bits: Therrien 2023, line 26
}

#if !LISTED
// A pixel counts as an edge if fewer than 7 of the 8 texels at distance 2 lie within half the plane
// tolerance of its facet's plane.
bool isEdge(vec2 pixel, float depth, Plane plane) {
  const float tolerance = toleranceAt(depth, settings.tolerance, kTexelTolerance * float(kScale));
  uint same = 0u;
  for (uint k = 0u; k < 8u; ++k) {
    const uint place = k + k / 4u;  // in a 3x3 block, without its centre
    const vec2 across = (vec2(place % 3u, place / 3u) - 1.0) * float(2u * kScale);
    const float other = textureLod(view_depth, attachmentAt(pixel + across), 0.0).x;
    same += planeDistance(plane, depth, other, across) * tolerance < 0.5 ? 1u : 0u;
  }
  return same < 7u;
}
#endif

// Visibility of a pixel: the mean over its slices. Sets `bent` to the mean open direction in view
// space.
float openAt(uvec2 texel, vec2 pixel, float depth, out vec3 bent) {
  bent = vec3(0.0);
  vec3 normal = viewNormal(textureLod(world_normal, attachmentAt(pixel), 0.0).xyz);
#if !LISTED
  const vec2 tangent = facetTangent(pixel, depth, normal, depthsAlong(pixel, vec2(1, 0)),
                                    depthsAlong(pixel, vec2(0, 1)));
  imageStore(tangents, ivec2(texel), uvec4(packHalf2x16(clamp(tangent, -6e4, 6e4))));
#endif
  const Raised at = raised(viewPosition(pixel, depth), normal, settings.bias);
  if (at.hidden) return 1.0;
  const vec3 position = at.position;
  const vec3 view_vec = towardsCamera(position);
  uint count = kSlices;
#if !LISTED
  if (kEdgeSlices > 1u) {
    if (isEdge(pixel, depth, planeOfTangent(pixel, tangent))) count = kSlices * kEdgeSlices;
  }
#endif
  // Interpolated normals may face away from the camera. Turns them to the silhouette, or a little
  // past it towards the camera if they face away by more than their rounding: at exactly edge-on,
  // rounding errors would decide.
  const float facing = dot(normal, view_vec);
  normal = normalize(normal + view_vec * max((facing < -1e-3 ? 1e-2 : 1e-3) - facing, 0.0));
  const mat3 axes = basisAbout(normal);
  // A block of 5x5 texels holds the 25 points of a Hammersley set. Every row, column and diagonal
  // of five has one point of each fifth of the circle: the denoiser then removes most of the
  // pattern even where it finds only a strip of texels.
  const uint first = (2u * texel.x + texel.y + settings.exchange.x) % 5u;
  const uint second = (texel.x + 2u * texel.y + settings.exchange.y) % 5u;
  const float turn = (float(first * 5u + second) + settings.turn) / 25.0;
  const float jitter = (float(second * 5u + first) + 0.5) / 25.0;
  float open = 0.0;
  for (uint k = 0u; k < count; ++k) {
    const float phi = (float(k) + turn) / float(count) * 2.0 * kPi;
    const float u = fract(jitter + float(k) * 0.618034);
    const float r = sqrt(u);
    const vec3 direction = axes * vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - u));
    open += sliceOf(position, view_vec, normal, direction, pixel + at.moved, u, bent);
  }
  bent /= float(count);
  return open / float(count);
}

// Visibility and view depth of a texel.
vec2 shade(ivec2 texel) {
  const vec2 pixel = vec2(texel) * float(kScale) + 0.5;
  const float depth = textureLod(view_depth, attachmentAt(pixel), 0.0).x;
  float open = 1.0;
  vec3 bent = vec3(0.0);
  if (depth > 0.0) open = openAt(uvec2(texel), pixel, depth, bent);
#if BENT
  imageStore(bent_target, texel, vec4(bent, 0.0));
#endif
  return vec2(open, depth);
}

void main() {
#if LISTED
  // From pixel to pixel; after a block's last one at once to the next block. With a loop over the
  // blocks and one over their pixels, invocations that have fewer pixels would wait for others.
  const uint end = blockEnd();
  uint next = firstBlock(), rest = 0u;  // pixels of the block still to come, a bit each
  Block block;
  while (rest != 0u || next < end) {
    if (rest == 0u) {
      block = blockAt(next);
      next += blockStride();
      rest = uint(dot(vec4(greaterThan(unpackUnorm4x8(block.shares), vec4(0.0))), vec4(1, 2, 4, 8)));
    }
    const int i = findLSB(rest);
    rest &= rest - 1u;
    const float open = shade(block.place + ivec2(i & 1, i >> 1)).x;
    vec4 opens = unpackUnorm4x8(block.open);
    opens[i] = mix(opens[i], open, unpackUnorm4x8(block.shares)[i]);
    block.open = packUnorm4x8(opens);
    if (rest == 0u) imageStore(blocks, block.place / 2, uvec4(block.open));
  }
#else
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(texel, imageSize(target)))) {
    imageStore(target, texel, vec4(shade(texel), 0.0, 0.0));
  }
#endif
}
