// SPDX-License-Identifier: MIT
// The sectors of a slice that its taps occlude. Part of slices.glsl, whose constants and textures it
// reads, and which names the papers.

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

// Here and below, x and y of a pair belong to the two sides of the view vector, which have these
// signs. They are computed side by side: their chains of dependent instructions are long, and a
// processor runs the two at once. On lavapipe this takes a fifth off.
const vec2 kSide = vec2(1.0, -1.0);

// A point on either side is given by how far it lies along the slice (`along`), and by its height over
// the tangent plane, over the length of the projected normal (`up`). A tap is the centre of a pixel and
// lies beside the slice. This frame moves it into the slice at its own height, which keeps planes open
// at any distance of the tap.
struct Slice {
  vec2 pixel;          // of the point that the slice starts at
  float depth;         // its view depth, metres
  vec3 ray;            // see rayDirection()
  vec3 along, up;      // tangent in the slice; normal / length of the projected normal
  float cos_n, sin_n;  // of the projected normal's angle n from the view vector
  float offset, scale; // share = offset + 2 integral * scale
};

// Share of the slice's cosine-weighted solid angle below the horizon of a point on each side. With h
// the horizon angle and n the projected normal's, the integral of |sin h| cos(h - n) from 0 to h is
// (cos n - cos(2 h - n)) / 4 + h sin(n) / 2 (Jimenez 2016, line 28). This equals
// (sin(h)^2 cos(n) + (h - sin h cos h) sin n) / 2.
vec2 sharesOf(Slice s, vec2 along, vec2 up) {
  const vec2 sin_n = kSide * s.sin_n;
  // The move into the slice may take a near tap across the view vector. This moves it back.
  along = mix(along, abs(along), lessThan(along * s.cos_n + up * sin_n, vec2(0.0)));
  vec2 x = max(along * s.cos_n + up * sin_n, 0.0), y = up * s.cos_n - along * sin_n;
  const vec2 inverse = inversesqrt(max(x * x + y * y, 1e-30));
  x *= inverse;
  y *= inverse;
  // h - sin h cos h, twice the area of a segment of the unit circle. Its quotient by sin h (1 - cos h)
  // is smooth from h = 0 to pi/2; this least-squares fit of it errs by at most 1.8e-5 in the area.
  const vec2 z = abs(y);
  const vec2 fit =
      1.5707784 + z * (-0.4276955 + z * (0.336371 + z * (-0.2169253 + 0.0723837 * z)));
  const vec2 lens = x * (1.0 - z) * fit;
  const vec2 segment = mix(lens, kPi - lens, lessThan(y, vec2(0.0)));
  const vec2 part = x * x * s.cos_n + segment * sin_n;
  // A point below the tangent plane is at the end of the hemisphere.
  return mix(s.offset + kSide * part * s.scale, 0.5 + 0.5 * kSide, lessThanEqual(up, vec2(0.0)));
}

#if BENT
// The sector, 0 to 31, of a direction in the slice at `angle` from the view vector.
uint sectorOf(Slice s, float angle) {
  const float side = angle < 0.0 ? -1.0 : 1.0, h = abs(angle), sin_n = side * s.sin_n;
  const float twice = cos(2.0 * h) * s.cos_n + sin(2.0 * h) * sin_n;
  const float part = 0.5 * (s.cos_n - twice) + h * sin_n;
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
  return sum * (2.0 * s.scale * kPi / float(kDirections));
}
#endif

// Mask of the sectors [from, to) of 32 (Therrien 2023, Algorithm 1, lines 14 to 19).
uint sectorRange(uint from, uint to) {
  const uint count = to - min(from, to);
  return count == 0u ? 0u : (0xffffffffu >> (32u - count)) << from;
}

// State of a slice between its taps, from the pixel outwards.
struct Taps {
  vec2 along, up;            // previous tap
  vec2 step_along, step_up;  // its offset from the tap before it
  vec2 share;                // see sharesOf(); of the previous tap
  vec2 depth;                // of the previous tap, metres; -1e30: the next tap does not connect to it
  vec2 beyond;               // of the previous tap: squared distance - squared radius
  vec2 farther;              // how much larger that is than for the tap before it
  vec2 seen;                 // number of taps inside the picture
  vec2 right, down;          // of the previous tap from the pixel, metres at a view depth of 1 m
};

uint sectorsBetween(vec2 low, vec2 high, float dither, bvec2 present) {
  const uvec2 from = uvec2(clamp(low * 32.0 + dither, 0.0, 32.0));
  const uvec2 to = uvec2(clamp(high * 32.0 + dither, 0.0, 32.0));
  return (present.x ? sectorRange(from.x, to.x) : 0u) | (present.y ? sectorRange(from.y, to.y) : 0u);
}

// Matter that a tap on each side found.
struct Solids {
  bvec2 seen;              // whether the tap lies inside the picture
  vec2 depth;              // of its front, metres; 0: none
  vec2 right, down;        // of the tap from the pixel, metres at a view depth of 1 m
  vec2 size;               // factor on them at this depth
  vec2 along, up;          // the front
  vec2 way_along, way_up;  // from the front along the ray, for 1 m of view depth
  vec2 beyond;             // squared distance of the front - squared radius
  vec2 near, far;          // where the matter is in the sphere, metres of view depth from the front
  bvec2 hit;               // whether any is
};

vec2 depthScales(vec2 depths) {
  return vec2(depthScale(depths.x), depthScale(depths.y));
}

// Thickness of the matter behind the fronts at `depth`, metres of view depth. `back`: see `known`.
vec2 thicknesses(vec2 depth, vec2 back, bool next) {
  if (next) return vec2(kNextThickness * settings.thickness);
  const vec2 assumed = vec2(settings.thickness);
  if (kBacks == 0u) return assumed;
  if (kBacks == 1u) return mix(assumed, back, greaterThanEqual(back, vec2(0.0)));
  return mix(assumed, max(back - depth, 0.0), greaterThan(back, vec2(0.0)));
}

// Matter at the pixels at.xy and at.zw, or that of the `next` surface behind its back.
Solids solidsAt(Slice s, vec4 at, bool next) {
  Solids found;
  const vec2 place_1 = attachmentAt(at.xy), place_2 = attachmentAt(at.zw);
  found.seen = bvec2(all(equal(clamp(place_1, vec2(0.0), vec2(1.0)), place_1)),
                     all(equal(clamp(place_2, vec2(0.0), vec2(1.0)), place_2)));
  vec2 depth, back = vec2(-1.0);
  if (next) {
    depth = vec2(textureLod(next_depth, place_1, 0.0).x, textureLod(next_depth, place_2, 0.0).x);
  } else {
    depth = vec2(textureLod(view_depth, place_1, 0.0).x, textureLod(view_depth, place_2, 0.0).x);
    if (kBacks != 0u) {
      back = vec2(textureLod(known, place_1, 0.0).x, textureLod(known, place_2, 0.0).x);
    }
  }
  found.depth = depth;
  // Differences from the pixel: their rounding errors are in proportion to them.
  const vec2 right = (at.xz - s.pixel.x) * view.view_from_pixel.x;
  const vec2 down = (at.yw - s.pixel.y) * view.view_from_pixel.y;
  const vec2 size = depthScales(depth), deeper = depth - s.depth;
  found.right = right;
  found.down = down;
  found.size = size;
  const vec2 ray_x = s.ray.x + right * perspective(), ray_y = s.ray.y + down * perspective();
  const vec2 x = size * right + deeper * s.ray.x, y = size * down + deeper * s.ray.y;
  // Clips the solid, front + k ray with k in [0, thickness], to the sphere.
  const vec2 a = 1.0 / (ray_x * ray_x + ray_y * ray_y + 1.0);
  const vec2 b = (ray_x * x + ray_y * y + deeper) * a;
  found.beyond = x * x + y * y + deeper * deeper - settings.radius * settings.radius;
  const vec2 d = b * b - found.beyond * a;
  const vec2 root = sqrt(max(d, 0.0));
  found.near = max(-b - root, 0.0);
  found.far = min(thicknesses(depth, back, next), root - b);
  const bvec2 some = lessThanEqual(found.near, found.far);
  found.hit = bvec2(d.x > 0.0 && some.x, d.y > 0.0 && some.y);
  const vec2 flat_along = kSide * (right * s.along.x + down * s.along.y);
  const vec2 flat_up = right * s.up.x + down * s.up.y;
  const vec2 ray_along = kSide * dot(s.ray, s.along);
  const float ray_up = dot(s.ray, s.up);
  found.along = size * flat_along + deeper * ray_along;
  found.up = size * flat_up + deeper * ray_up;
  found.way_along = perspective() * flat_along + ray_along;
  found.way_up = perspective() * flat_up + ray_up;
  return found;
}

// Occluded sectors of a tap on each side: those between the front and the back of its matter.
uint sectorsOfTaps(Slice s, Solids tap, float dither, bool next, inout Taps before) {
  // Two successive taps whose depths differ by less than the thickness belong to one surface: the
  // sectors between them are occluded too, up to the sphere. With few taps this has a smaller error
  // than gaps between the taps, even if the back is known.
  const vec2 deeper = abs(tap.depth - before.depth);
  const bvec2 inside = lessThanEqual(tap.beyond, vec2(0.0));
  bvec2 connected = lessThan(deeper, vec2(settings.thickness));
  vec2 wide = vec2(0.0);
  if (kBacks != 0u) {
    const vec2 x = tap.size * (tap.right - before.right), y = tap.size * (tap.down - before.down);
    const vec2 steepest = kSteepest * kSteepest * (x * x + y * y);
    connected = bvec2(connected.x && deeper.x * deeper.x < steepest.x,
                      connected.y && deeper.y * deeper.y < steepest.y);
    // A surface of one tap, such as a leaf or a bar, stands for what lies between taps: it reaches
    // to both sides, parallel to the pixel's tangent plane.
    if (!next) {
      const bvec2 alone = bvec2(inside.x && !connected.x && before.seen.x > 0.0,
                                inside.y && !connected.y && before.seen.y > 0.0);
      const float reach = kBacks == 3u ? kLoneAboveNext : kLone;
      wide = mix(vec2(0.0), kSide * reach * (x * s.along.x + y * s.along.y), alone);
    }
  }
  const bvec2 leaves = bvec2(connected.x && !inside.x, connected.y && !inside.y);
  // A surface that leaves the sphere between two taps does so where the squared distance, taken as
  // linear between them, is the squared radius.
  const vec2 inner = before.beyond / min(before.beyond - tap.beyond, vec2(-1e-30));
  const vec2 to_along = mix(tap.along + tap.far * tap.way_along + wide,
                            mix(before.along, tap.along, inner), leaves);
  const vec2 to_up = mix(tap.up + tap.far * tap.way_up, mix(before.up, tap.up, inner), leaves);
  const vec2 last = sharesOf(s, to_along, to_up);
  const vec2 first = sharesOf(s, tap.along + tap.near * tap.way_along - wide,
                              tap.up + tap.near * tap.way_up);
  const vec2 begin = mix(first, before.share, leaves), other = mix(first, before.share, connected);
  const vec2 low = min(min(begin, other), last), high = max(max(begin, other), last);
  const bvec2 present = bvec2(tap.seen.x && tap.depth.x > 0.0 && (leaves.x || tap.hit.x),
                              tap.seen.y && tap.depth.y > 0.0 && (leaves.y || tap.hit.y));
  const bvec2 goes_on = bvec2(present.x && inside.x, present.y && inside.y);
  // Beyond the border the state stays.
  const vec2 none = vec2(0.0);
  before.step_along =
      mix(before.step_along, mix(none, tap.along - before.along, connected), tap.seen);
  before.step_up = mix(before.step_up, mix(none, tap.up - before.up, connected), tap.seen);
  before.farther = mix(before.farther, max(tap.beyond - before.beyond, 1e-30), tap.seen);
  before.along = mix(before.along, tap.along, tap.seen);
  before.up = mix(before.up, tap.up, tap.seen);
  before.share = mix(before.share, first, tap.seen);
  before.depth = mix(before.depth, mix(vec2(-1e30), tap.depth, goes_on), tap.seen);
  before.beyond = mix(before.beyond, tap.beyond, tap.seen);
  before.seen += vec2(tap.seen);
  before.right = mix(before.right, tap.right, tap.seen);
  before.down = mix(before.down, tap.down, tap.seen);
  return sectorsBetween(low, high, dither, present);
}

// Occluded sectors beyond the last tap in the picture: its surface goes on in its direction until it
// leaves the sphere. That is at most one step further, and more if taps lie beyond the border.
uint sectorsBeyond(Slice s, Taps last, float dither) {
  const vec2 most = 1.0 + kBeyondBorder * (float(kSteps) - last.seen);
  const vec2 more = min(-last.beyond / last.farther, most);
  const vec2 share =
      sharesOf(s, last.along + more * last.step_along, last.up + more * last.step_up);
  return sectorsBetween(min(last.share, share), max(last.share, share), dither,
                        greaterThan(last.depth, vec2(0.0)));
}
