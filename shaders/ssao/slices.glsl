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
// pixels of listed blocks (listed.glsl), at the picture's resolution, none of them as an edge.
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
#endif
#if BENT
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_target;  // in view space, any length
#endif

const float kPi = 3.14159265358979;
// With known backs: two taps belong to one surface only if it is at most this steep, in metres of
// view depth per metre across the view.
const float kSteepest = 6.5;
// With known backs: how far a tap of its own surface reaches to both sides, in distances from the
// tap before it.
const float kLone = 2.5;
const float kLoneAboveNext = 1.5;  // if the surface behind is known
// Depth of the solid behind the back, in thicknesses.
const float kNextThickness = 0.1;
// How far the last surface goes on beyond the picture's border, in steps for each tap that lies there.
const float kBeyondBorder = 2.0;

// Error at most 7e-5 radians: Hastings 1955, "Approximations for Digital Computers", sheet 38; x in
// [0, 1].
float arcCosine(float x) {
  return sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - 0.0187293 * x)));
}

struct Slice {
  vec3 position;
  vec3 along, up;      // tangent in the slice; normal / length of the projected normal
  float cos_n, sin_n;  // of the projected normal's angle n from the view vector
  float offset, scale; // share = offset + integral * scale
};

// A point in the frame of a slice, on one `side` of the view vector (1 or -1): how far it lies along
// the slice, and its height over the tangent plane over the length of the projected normal. A tap is
// the centre of a pixel and lies beside the slice. The frame moves it into the slice at its own
// height, which keeps planes open at any distance of the tap.
vec2 inSlice(Slice s, vec3 point, float side) {
  return vec2(side * dot(point, s.along), dot(point, s.up));
}

// Share of the slice's cosine-weighted solid angle below the horizon of a point of inSlice(). With h
// the horizon angle and n the projected normal's, the integral of |sin h| cos(h - n) from 0 to h is
// (cos n - cos(2 h - n)) / 4 + h sin(n) / 2 (Jimenez 2016, line 28). This equals
// (sin(h)^2 cos(n) + (h - sin h cos h) sin n) / 2.
float shareOf(Slice s, vec2 local, float side) {
  const float sin_n = side * s.sin_n;
  // The move into the slice may take a near tap across the view vector. This moves it back.
  if (local.x * s.cos_n + local.y * sin_n < 0.0) local.x = abs(local.x);
  vec2 at = vec2(max(local.x * s.cos_n + local.y * sin_n, 0.0),
                 local.y * s.cos_n - local.x * sin_n);
  at *= inversesqrt(max(dot(at, at), 1e-30));
  // h - sin h cos h, twice the area of a segment of the unit circle. Its quotient by sin h (1 - cos h)
  // is smooth from h = 0 to pi/2; this least-squares fit of it errs by at most 1.8e-5 in the area.
  const float y = abs(at.y);
  const float fit =
      1.5707784 + y * (-0.4276955 + y * (0.336371 + y * (-0.2169253 + 0.0723837 * y)));
  const float lens = at.x * (1.0 - y) * fit;
  const float segment = at.y < 0.0 ? kPi - lens : lens;
  const float part = 0.5 * (at.x * at.x * s.cos_n + segment * sin_n);
  // A point below the tangent plane is at the end of the hemisphere.
  return local.y <= 0.0 ? 0.5 + 0.5 * side : s.offset + side * part * s.scale;
}

#if BENT
// The sector, 0 to 31, of a direction in the slice at `angle` from the view vector.
uint sectorOf(Slice s, float angle) {
  const float side = angle < 0.0 ? -1.0 : 1.0, h = abs(angle), sin_n = side * s.sin_n;
  const float twice = cos(2.0 * h) * s.cos_n + sin(2.0 * h) * sin_n;
  const float part = 0.25 * (s.cos_n - twice) + 0.5 * h * sin_n;
  return uint(clamp((s.offset + side * part * s.scale) * 32.0, 0.0, 31.0));
}

// Cosine-weighted mean of the slice's directions in open sectors, from 16 directions.
vec3 meanOpen(Slice s, float n, vec3 ortho_direction, vec3 view_vec, uint occluded) {
  const uint kDirections = 16u;
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < kDirections; ++i) {
    const float angle = n + ((float(i) + 0.5) / float(kDirections) - 0.5) * kPi;
    const float weight = abs(sin(angle)) * cos(angle - n);
    const bool open = (occluded >> sectorOf(s, angle) & 1u) == 0u;
    if (open) sum += weight * (ortho_direction * sin(angle) + view_vec * cos(angle));
  }
  return sum * (s.scale * kPi / float(kDirections));
}
#endif

// Mask of the sectors [from, to) of 32 (Therrien 2023, Algorithm 1, lines 14 to 19).
uint sectorRange(uint from, uint to) {
  const uint count = to - min(from, to);
  return count == 0u ? 0u : (0xffffffffu >> (32u - count)) << from;
}

// State of one side of a slice between its taps, from the pixel outwards.
struct Side {
  vec2 point, step;  // previous tap, see inSlice(); its offset from the tap before it
  float share;       // see shareOf(); of the previous tap
  float depth;       // of the previous tap, metres; -1e30: the next tap does not connect to it
  float beyond;      // of the previous tap: squared distance - squared radius
  float farther;     // how much larger that is than for the tap before it
  float seen;        // number of taps inside the picture
  vec2 at;           // of the previous tap, pixels
};

uint sectorsBetween(float low, float high, float dither) {
  return sectorRange(uint(clamp(low * 32.0 + dither, 0.0, 32.0)),
                uint(clamp(high * 32.0 + dither, 0.0, 32.0)));
}

// Occluded sectors of one tap: those between the front and the back of its surface, or of the `next`
// surface behind that back.
uint sectorsOfTap(Slice s, vec2 at, float side, float dither, bool next, inout Side before) {
  const vec2 place = attachmentAt(at);
  const bool seen = all(equal(clamp(place, vec2(0.0), vec2(1.0)), place));
  const float depth =
      next ? textureLod(next_depth, place, 0.0).x : textureLod(view_depth, place, 0.0).x;
  const vec3 ray = rayDirection(at);
  const vec3 front = viewPosition(at, depth) - s.position;
  // Clips the solid, front + k ray with k in [0, thickness], to the sphere.
  const float a = 1.0 / dot(ray, ray), b = dot(ray, front) * a;
  const float beyond = dot(front, front) - settings.radius * settings.radius;
  const float d = b * b - beyond * a;
  const float root = sqrt(max(d, 0.0));
  float thick = next ? kNextThickness * settings.thickness : settings.thickness;
  if (kBacks != 0u && !next) {
    const float back = textureLod(known, place, 0.0).x;
    if (kBacks >= 2u ? back > 0.0 : back >= 0.0) {
      thick = kBacks >= 2u ? max(back - depth, 0.0) : back;
    }
  }
  const float near = max(0.0, -b - root), far = min(thick, root - b);
  const vec2 point = inSlice(s, front, side), way = inSlice(s, ray, side);
  // Two successive taps whose depths differ by less than the thickness belong to one surface: the
  // sectors between them are occluded too, up to the sphere. With few taps this has a smaller error
  // than gaps between the taps, even if the back is known.
  const bool inside = beyond <= 0.0;
  const float deeper = abs(depth - before.depth);
  bool connected = deeper < settings.thickness;
  vec2 wide = vec2(0.0);
  if (kBacks != 0u) {
    const vec2 across = depthScale(depth) * (at - before.at) * view.view_from_pixel.xy;
    connected = connected && deeper * deeper < kSteepest * kSteepest * dot(across, across);
    // A surface of one tap, such as a leaf or a bar, stands for what lies between taps: it reaches
    // to both sides, parallel to the pixel's tangent plane.
    if (inside && !connected && !next && before.seen > 0.0) {
      wide.x = side * (kBacks == 3u ? kLoneAboveNext : kLone) * dot(across, s.along.xy);
    }
  }
  const bool leaves = connected && !inside;
  // A surface that leaves the sphere between two taps does so where the squared distance, taken as
  // linear between them, is the squared radius.
  const float inner = before.beyond / min(before.beyond - beyond, -1e-30);
  const vec2 to = leaves ? mix(before.point, point, inner) : point + far * way + wide;
  const float first = shareOf(s, point + near * way - wide, side), last = shareOf(s, to, side);
  const float low = min(leaves ? before.share : min(first, connected ? before.share : 1.0), last);
  const float high = max(leaves ? before.share : max(first, connected ? before.share : 0.0), last);
  if (!seen) return 0u;  // beyond the border; asked here, because software drivers mask what follows
  const bool present = depth > 0.0 && (leaves || (d > 0.0 && near <= far));
  before.step = connected ? point - before.point : vec2(0.0);
  before.farther = max(beyond - before.beyond, 1e-30);
  before.point = point;
  before.share = first;
  before.depth = present && inside ? depth : -1e30;
  before.beyond = beyond;
  before.seen += 1.0;
  before.at = at;
  return present ? sectorsBetween(low, high, dither) : 0u;
}

// Occluded sectors beyond the last tap in the picture: its surface goes on in its direction until it
// leaves the sphere. That is at most one step further, and more if taps lie beyond the border.
uint sectorsBeyond(Slice s, Side last, float side, float dither) {
  const float most = 1.0 + kBeyondBorder * (float(kSteps) - last.seen);
  const float more = min(-last.beyond / last.farther, most);
  const float share = shareOf(s, last.point + more * last.step, side);
  return last.depth > 0.0 ? sectorsBetween(min(last.share, share), max(last.share, share), dither) : 0u;
}

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
  s.position = position;
  s.along = ortho_direction * at.y - view_vec * at.x;
  s.up = normal * inverse_length;
  s.cos_n = at.y;
  s.sin_n = at.x;
  // The integral over the whole slice is cos n + n sin n; below the view vector it is half of
  // cos n + (n - pi/2) sin n.
  const float angle = arcCosine(min(abs(at.y), 1.0));
  const float n = sign(at.x) * (at.y < 0.0 ? kPi - angle : angle);
  s.scale = 1.0 / (s.cos_n + n * s.sin_n);
  s.offset = 0.5 * (s.cos_n + (n - 0.5 * kPi) * s.sin_n) * s.scale;

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
  Side ahead = Side(vec2(0.0), vec2(0.0), 1.0, own, centre, 1.0, 0.0, pixel);
  Side behind = Side(vec2(0.0), vec2(0.0), 0.0, own, centre, 1.0, 0.0, pixel);
  Side next_ahead = ahead, next_behind = behind;
  // Not unrolled: unrolling costs a third more on lavapipe and gains nothing elsewhere.
  for (uint i = 0u; i < kSteps; ++i) {
    // Taps are denser near the pixel. Tap i is at least i + 1 pixels away.
    const float one = (float(i) + jitter) / float(kSteps);
    const float two = (float(i) + 1.0 - jitter) / float(kSteps);
    const float least = float(i) + 1.0;
    const float to = max(one * sqrt(one) * reach, least);
    const float back = max(two * sqrt(two) * reach, least);
    const vec2 tap_ahead = tapAt(pixel, way, to), tap_behind = tapAt(pixel, -way, back);
    occluded |= sectorsOfTap(s, tap_ahead, 1.0, jitter, false, ahead);
    occluded |= sectorsOfTap(s, tap_behind, -1.0, jitter, false, behind);
    if (kBacks == 3u) {
      occluded |= sectorsOfTap(s, tap_ahead, 1.0, jitter, true, next_ahead);
      occluded |= sectorsOfTap(s, tap_behind, -1.0, jitter, true, next_behind);
    }
  }
  occluded |= sectorsBeyond(s, ahead, 1.0, jitter) | sectorsBeyond(s, behind, -1.0, jitter);
#if BENT
  bent += meanOpen(s, n, ortho_direction, view_vec, occluded);
#endif
  return 1.0 - float(bitCount(occluded)) / 32.0;  // share of clear bits: Therrien 2023, line 26
}

#if !LISTED
// A pixel counts as an edge if fewer than 7 of the 8 texels at distance 2 lie within half the plane
// tolerance of its tangent plane.
bool isEdge(vec2 pixel, float depth, vec3 normal) {
  const Plane plane = planeOf(pixel, normal);
  const float tolerance = toleranceAt(depth, settings.tolerance);
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
  const Raised at = raised(viewPosition(pixel, depth), normal, settings.bias);
  if (at.hidden) return 1.0;
  const vec3 position = at.position;
  const vec3 view_vec = towardsCamera(position);
  uint count = kSlices;
#if !LISTED
  if (kEdgeSlices > 1u) {
    if (isEdge(pixel, depth, normal)) count = kSlices * kEdgeSlices;
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
