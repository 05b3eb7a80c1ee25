// SPDX-License-Identifier: MIT
// Composites any number of shots at a point of a surface.
//
// A hash grid of the world has a list of shots for each cell and facing, newest first. The walk
// composites this list front to back, and ends early, when no older shot changes the outputs any
// more. A shot paints only what its muzzle sees, by its map (effects/sspm/shot_map.h).
//
// Include splat.glsl before.

// Levels are hash grids of different cell width, for shots of different range.
const uint kLevels = 16;
// All shots are on one level, as in most scenes.
layout(constant_id = 1) const bool kOneLevel = false;
layout(UNIFORM(2), std140) uniform Lists {
  ivec4 level_cell[kLevels];      // xyz: the camera's cell; w: code of the level
  vec4 level_fraction[kLevels];   // xyz: the camera's position in it, in cells; w: cells per metre
  ivec4 camera_cell;              // xyz: the camera's position, whole metres; w: number of levels
  vec4 camera_fraction;           // xyz: its remainder, -0.5 to 0.5 metres; w: r0, metres
  uint slot_count;
  float per_fade;                 // 1 / edge_fade
} lists;

struct Shot {
  ivec3 cell;          // the muzzle's world position, whole metres
  float range;         // metres
  vec3 fraction;       // the position's remainder, -0.5 to 0.5 metres
  float slope;         // s0 of shot_map.h
  vec3 direction;      // unit
  uint number;         // 1 + the shot's number
  uint color_rg;       // half floats
  uint color_b_times;  // half floats: blue; number of times that the alpha counts
  uint base;           // first block of the map
  // Reference to the map's root; plus kCoarse if the map is coarse; from bit 17 on: the range that
  // the map was made for, as a share of `range`, a half float without its sign.
  uint root;
};
// Hash table with linear probing. Six words per slot: cell (3), code (-1: free), first unit of the
// list, number of units.
layout(STORAGE(0), std430) readonly buffer Slots { int slots[]; };
// Lists of units of four words. An entry is a unit: index into shots[], reference within its map,
// bits of the parts (2). Five units are a mask of what the entries after it reach, before a group of
// them or a block of up to 16 groups (effects/sspm/groups.h): kMask plus the number of units to pass
// over if the point is not there, 0, bits of the parts (2) and of the squares (16).
layout(STORAGE(1), std430) readonly buffer Entries { uint entries[]; };
layout(STORAGE(2), std430) readonly buffer Shots { Shot shots[]; };
layout(STORAGE(3), std430) readonly buffer Maps { uint blocks[]; };  // two words per block

// Same as in effects/sspm/shot_map.h and shot_map.cpp.
const float kMapReach = 8.0;
const float kBiasUnits = 0.02, kBiasShare = 2e-5;
const float kSlant = 8.0, kOther = -0.5, kSame = 0.3, kLeastBias = 0.05;
const float kLineReach = 12.0, kLineSlack = 1.0 / 512.0;
const uint kLine = 0x2000u, kTwo = 0x4000u, kFour = 0x6000u, kEight = 0x8000u, kTag = 0xE000u;
const uint kCoarse = 0x10000u, kMapRangeShift = 17u;  // effects/sspm/paint_world.cpp

// The range that a shot's map was made for, metres: the shot's, unless that has just changed.
float mapRange(Shot shot) {
  return shot.range * unpackHalf2x16(shot.root >> kMapRangeShift).x;
}

// A line's normal, with |x| + |y| = 1, from a turn of 0 to 4.
vec2 lineNormal(float turn) {
  const float x = turn < 2.0 ? 1.0 - turn : turn - 3.0;
  return vec2(x, (turn < 2.0 ? 1.0 : -1.0) * (1.0 - abs(x)));
}

vec3 planeNormal(uint packed) {
  const vec2 flat_normal = unpackSnorm2x16(packed);
  vec3 normal = vec3(flat_normal, 1.0 - abs(flat_normal.x) - abs(flat_normal.y));
  const float under = max(-normal.z, 0.0);
  normal.x += normal.x >= 0.0 ? -under : under;
  normal.y += normal.y >= 0.0 ? -under : under;
  return normalize(normal);
}

// Reference of square `square` of a node. first: the node's first word.
uint squareOf(uint tag, uint block, uint first, uint square) {
  uint part = square;
  if (tag == kTwo) {
    part = 1u + (first >> square & 1u);
  } else if (tag == kFour) {
    part = 2u + (first >> 2u * square & 3u);
  } else if (tag == kEight) {
    part = 4u + ((square < 10u ? first >> 3u * square : blocks[block + 1u] >> 3u * (square - 10u)) & 7u);
  }
  return blocks[block + part / 2u] >> 16u * (part & 1u) & 0xFFFFu;
}

// Whether a point lies before a leaf's plane, with a bias.
// at: reference to the plane, or 0: no surface.
bool isBefore(Shot shot, uint at, vec3 q, vec3 facing) {
  if (at == 0u) return true;
  const uint block = (shot.base + at - 1u) * 2u;
  const vec3 normal = planeNormal(blocks[block]);
  const float behind = uintBitsToFloat(blocks[block + 1u]) - dot(normal, q);
  const float range = mapRange(shot);
  const float least = kBiasUnits * range + kBiasShare * range / shot.slope;
  const float bias = least * clamp((dot(normal, facing) - kOther) / (kSame - kOther), kLeastBias, 1.0);
  return behind <= bias && behind * length(q) <= kSlant * bias * abs(dot(normal, q));
}

// Visibility test of a shadow map: whether the muzzle sees the point at offset q on a facet with
// normal `facing`. Descends the map's tree to a leaf, and compares q with the leaf's plane. Same as
// inSight() of effects/sspm/shot_map.cpp, which explains the bias.
// at: reference within the map, where the descent starts. along: dot(q, direction).
// across: offset of q from the ray, along axesAcross(). Beyond the range of the map it sees what is
// at its rim, as if the surface there continued.
bool inSight(Shot shot, uint at, vec3 q, float along, vec2 across, vec3 facing) {
  uint other = 0xFFFFu;  // what lies beyond a line that is close
  if (at >= kLine) {
    const float inside = min(1.0, mapRange(shot) / max(length(across), 1e-30));
    vec2 place = across * (inside / (max(along, 1e-20) * shot.slope));
    const float radius = length(place);
    if (radius > 1.0) place *= min(1.0 + log(radius), 0.999 * kMapReach) / radius;
    vec2 in_square = (place + kMapReach) * (2.0 / kMapReach);
    while (at >= kLine) {
      const uint block = (shot.base + (at & ~kTag)) * 2u;
      const uint tag = at & kTag;
      const uint first = blocks[block];
      if (tag == kLine) {
        const uint second = blocks[block + 1u];
        const float turn = float(second & 0xFFFFu) / 16384.0;
        const float offset = float(int(second) >> 16) * (kLineReach / 32767.0);
        const float off = dot(lineNormal(turn), place) - offset;
        at = off > 0.0 ? first >> 16 : first & 0xFFFFu;
        if (abs(off) < kLineSlack) other = off > 0.0 ? first & 0xFFFFu : first >> 16;
      } else {
        const vec2 square = clamp(floor(in_square), 0.0, 3.0);
        at = squareOf(tag, block, first, uint(square.y) * 4u + uint(square.x));
        in_square = (in_square - square) * 4.0;
      }
    }
  }
  return isBefore(shot, at, q, facing) || (other != 0xFFFFu && isBefore(shot, other, q, facing));
}

// Spatial hash: xor of the coordinates times primes (Teschner et al. 2003), then mixed. Same as
// hashOf() of effects/sspm/cell_table.cpp.
uint hashCell(ivec3 cell, int code) {
  const uvec3 c = uvec3(cell);
  uint h = c.x * 0x9e3779b1u ^ c.y * 0x85ebca77u ^ c.z * 0xc2b2ae3du ^ uint(code) * 0x27d4eb2fu;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  return h ^ h >> 12;
}

// A list's units: x: first, y: end. Both 0 without paint. The search starts at the hash as a share
// of all slots.
uvec2 findCell(ivec3 cell, int code) {
  uint first, low;
  umulExtended(hashCell(cell, code), lists.slot_count, first, low);
  for (uint i = first;; i = i + 1u < lists.slot_count ? i + 1u : 0u) {
    const uint slot = i * 6u;
    if (slots[slot + 3u] < 0) return uvec2(0u);
    if (slots[slot + 3u] == code && ivec3(slots[slot], slots[slot + 1u], slots[slot + 2u]) == cell) {
      return uvec2(slots[slot + 4u], slots[slot + 4u] + slots[slot + 5u]);
    }
  }
}

// Facing of a normal, 0 to 5: its largest component, x, y or z, and its sign.
int facingOf(vec3 normal) {
  const vec3 n = abs(normal);
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  return axis * 2 + (normal[axis] < 0.0 ? 1 : 0);
}

// A point of a surface.
struct Point {
  vec3 from_camera;  // position relative to the camera, world axes, metres
  vec3 normal;       // of its facet
  float pixel;       // width of a pixel there, metres
};

// Offset of a point from the muzzle of a shot, by its record.
vec3 fromMuzzle(uint record, vec3 from_camera) {
  return from_camera - (vec3(shots[record].cell - lists.camera_cell.xyz) +
                        (shots[record].fraction - lists.camera_fraction.xyz));
}

// Whether the point lies in a shot's cylinder, and its facet faces the muzzle.
bool isReached(uint record, Point point) {
  const vec3 q = fromMuzzle(record, point.from_camera), direction = shots[record].direction;
  return dot(q, direction) >= 0.0 && length(q * axesAcross(direction)) < shots[record].range &&
         dot(q, point.normal) < 0.0;
}

// A list, and how far a walk has come in it.
struct List {
  uint next;   // unit
  uint end;
  uint place;  // of the point: bits 0 to 5: part of the cell; from bit 6 on: square
};

const uint kMask = 0x80000000u;  // effects/sspm/cell_table.cpp

// Goes on to the next entry whose bits and masks have the point; else to the end.
void findInMasks(inout List list) {
  const uint square = list.place >> 6;
  const uint part = list.place >> 5 & 1u, bit = 1u << (list.place & 31u);
  bool found = false;
  while (list.next < list.end && !found) {
    const uint word = list.next * 4u, first = entries[word];
    const bool touched = (entries[word + 2u + part] & bit) != 0u;
    if (first >= kMask) {
      const bool reaches =
          touched && (entries[word + 4u + square / 32u] >> (square & 31u) & 1u) != 0u;
      list.next += 5u + (reaches ? 0u : first - kMask);
    } else {
      found = touched;
      if (!found) ++list.next;
    }
  }
}

vec3 colorOf(Shot shot) {
  return vec3(unpackHalf2x16(shot.color_rg), unpackHalf2x16(shot.color_b_times).x);
}

// Composites one shot, at an offset `across` from its ray.
void compositeShot(inout Sum sum, uint record, Shot shot, vec2 across, float pixel) {
  composite(sum, across, pixel, splatSeed(shot.fraction, shot.direction), shot.range,
            lists.camera_fraction.w, lists.per_fade, unpackHalf2x16(shot.color_b_times).y,
            colorOf(shot), record + 1u);
}

// Composites a list's entry, which reaches the point, if the shot's muzzle sees the point. Otherwise
// `blocked` becomes 1 + the shot's record, unless it is set.
void compositeEntry(inout Sum sum, inout uint blocked, uint entry, Point point) {
  const uint record = entries[entry * 4u];
  const Shot shot = shots[record];
  const vec3 q = fromMuzzle(record, point.from_camera);
  const float along = dot(q, shot.direction);
  const vec2 across = q * axesAcross(shot.direction);
  // Entries refer into the exact map.
  const uint start = (shot.root & kCoarse) == 0u ? entries[entry * 4u + 1u] : shot.root & 0xFFFFu;
  if (inSight(shot, start, q, along, across, point.normal)) {
    compositeShot(sum, record, shot, across, point.pixel);
  } else if (blocked == 0u) {
    blocked = record + 1u;
  }
}

// Goes on to the next entry whose shot reaches the point; else to the end. It has a loop of its own:
// threads run in step, and none waits while others ask a shot's map (Aila and Laine 2009,
// "Understanding the Efficiency of Ray Traversal on GPUs").
void findEntry(inout List list, Point point) {
  bool found = false;
  do {
    findInMasks(list);
    found = list.next < list.end && isReached(entries[list.next * 4u], point);
    if (!found) ++list.next;
  } while (!found && list.next < list.end);
}

// List of the point's cell on a level.
List listOn(uint level, Point point) {
  const vec3 place = point.from_camera * lists.level_fraction[level].w + lists.level_fraction[level].xyz;
  const vec3 whole = floor(clamp(place, -1e9, 1e9));
  const uvec3 square = uvec3(clamp((place - whole) * 16.0, 0.0, 15.0)), part = square >> 2;
  const int facing = facingOf(point.normal), axis = facing >> 1;
  const uvec2 run =
      findCell(lists.level_cell[level].xyz + ivec3(whole), lists.level_cell[level].w + facing);
  return List(run.x, run.y,
              part.x | part.y << 2 | part.z << 4 | square[(axis + 1) % 3] << 6 |
                  square[(axis + 2) % 3] << 10 | part[axis] >> 1 << 14);
}

// Walk with one level. It needs no array of list heads.
void walkOne(inout Sum sum, inout uint blocked, Point point, bool covered) {
  List list = listOn(0u, point);
  do {
    findEntry(list, point);
    if (list.next < list.end) compositeEntry(sum, blocked, list.next, point);
    ++list.next;
  } while (list.next < list.end && isOpen(sum, covered));
}

// Walk with several levels: merges their lists by the shots' numbers, newest first.
void walkAll(inout Sum sum, inout uint blocked, Point point, bool covered) {
  List heads[kLevels];
  uint live = 0u;
  for (uint i = 0u; i < uint(lists.camera_cell.w); ++i) {
    List list = listOn(i, point);
    findEntry(list, point);
    if (list.next < list.end) heads[live++] = list;
  }
  while (live > 0u && isOpen(sum, covered)) {
    uint newest = 0u, number = shots[entries[heads[0].next * 4u]].number;
    for (uint i = 1u; i < live; ++i) {
      const uint other = shots[entries[heads[i].next * 4u]].number;
      if (other > number) {
        number = other;
        newest = i;
      }
    }
    List list = heads[newest];
    compositeEntry(sum, blocked, list.next, point);
    ++list.next;
    findEntry(list, point);
    if (list.next >= list.end) list = heads[--live];
    heads[newest] = list;
  }
}

// Composites the shots at a point. The sum's owner is 1 + a record.
// covered: see isOpen(). blocked: gets 1 + the record of the newest shot that would paint the point
// but does not see it; 0: none.
Sum walk(Point point, bool covered, out uint blocked) {
  Sum sum = kNothing;
  blocked = 0u;
  if (kOneLevel) {
    walkOne(sum, blocked, point, covered);
  } else {
    walkAll(sum, blocked, point, covered);
  }
  return sum;
}

// 1 + the number of the shot of an owner; 0: none.
uint numberOf(uint owner) {
  return owner == 0u ? 0u : shots[owner - 1u].number;
}
