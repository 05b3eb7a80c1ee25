// SPDX-License-Identifier: MIT
// Any number of shots: a place on a surface walks the shots listed for its cell of the world and its
// facing, newest first, T = prod(1 - alpha), C = sum(alpha c T), A = sum(alpha), until no older one
// changes what is written.
// A shot paints what its muzzle sees: effects/sspm/shot_map.h says how that is held.
// Before it: kWanted, whose bit 4 asks for the owner.

const uint kLevels = 16;
// Most scenes have shots of one range alone.
layout(constant_id = 1) const bool kOneLevel = false;
layout(UNIFORM(2), std140) uniform Lists {
  ivec4 level_cell[kLevels];      // xyz: the camera's cell; w: code of the level
  vec4 level_fraction[kLevels];   // xyz: the camera's place in it, in cells; w: cells a metre
  ivec4 camera_cell;              // the camera's place: nearest whole metres; w: number of levels
  vec4 camera_fraction;           // and the rest; w: r0, metres
  uint slot_mask;                 // number of slots, a power of two, less 1
  float per_fade;
} lists;

struct Shot {
  ivec3 cell;  // muzzle, world: nearest whole metres
  float range;
  vec3 fraction;
  float slope;
  vec3 direction;
  uint number;             // from 1
  uint color_rg;           // halves
  uint color_b_times;      // halves: blue; how often its alpha counts
  uint base;               // the map's first block
  uint root;
};
layout(STORAGE(0), std430) readonly buffer Slots { int slots[]; };  // six a slot: cell, code (-1: free), first entry, count
layout(STORAGE(1), std430) readonly buffer Entries { uint entries[]; };  // four an entry: of shots[], word, parts of the cell (2)
layout(STORAGE(2), std430) readonly buffer Shots { Shot shots[]; };
layout(STORAGE(3), std430) readonly buffer Blocks { uint blocks[]; };  // four words a block

const float kMapReach = 8.0;
const float kBiasUnits = 0.02, kBiasShare = 2e-5;
const float kSlant = 8.0, kOther = -0.5, kSame = 0.3, kLeastBias = 0.05;
const uint kPlane = 0x40000000u, kNode = 0x80000000u, kTag = 0xC0000000u;

// As inSight() of effects/sspm/shot_map.cpp.
bool inSight(Shot shot, uint word, vec3 q, float along, vec3 facing) {
  if ((word & kNode) != 0u) {
    const vec3 w = shot.direction;
    const float s = w.z >= 0.0 ? 1.0 : -1.0;
    const float a = -1.0 / (s + w.z);
    const float b = w.x * w.y * a;
    const vec3 right = vec3(1.0 + s * w.x * w.x * a, s * b, -s * w.x);
    const vec3 up = vec3(b, s + w.y * w.y * a, -w.y);
    vec2 place = vec2(dot(q, right), dot(q, up)) / (max(along, 1e-20) * shot.slope);
    const float radius = length(place);
    if (radius > 1.0) place *= min(1.0 + log(radius), 0.999 * kMapReach) / radius;
    vec2 at = (place + kMapReach) * (2.0 / kMapReach);
    while ((word & kNode) != 0u) {
      const vec2 square = clamp(floor(at), 0.0, 3.0);
      const uint bit = uint(square.y) * 4u + uint(square.x);
      const uint block = (shot.base + (word & ~kTag)) * 4u;
      const bool node = (word & kTag) == kNode;
      word = blocks[block + (node ? bit : 0u)];
      if (!node) word = blocks[block + 1u + (word >> bit & 1u)];
      at = (at - square) * 4.0;
    }
  }
  if (word == 0u) return true;
  const uint block = (shot.base + (word & ~kTag)) * 4u;
  const vec4 plane = uintBitsToFloat(uvec4(blocks[block], blocks[block + 1u], blocks[block + 2u], blocks[block + 3u]));
  const float behind = plane.w - dot(plane.xyz, q);
  const float least = kBiasUnits * shot.range + kBiasShare * shot.range / shot.slope;
  const float bias = least * clamp((dot(plane.xyz, facing) - kOther) / (kSame - kOther), kLeastBias, 1.0);
  return behind <= bias && behind * length(q) <= kSlant * bias * abs(dot(plane.xyz, q));
}

uint hashCell(ivec3 cell, int code) {
  const uvec3 c = uvec3(cell);
  uint h = c.x * 0x9e3779b1u ^ c.y * 0x85ebca77u ^ c.z * 0xc2b2ae3du ^ uint(code) * 0x27d4eb2fu;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  return h ^ h >> 12;
}

// First and count of the entries of a cell.
uvec2 find(ivec3 cell, int code) {
  for (uint i = hashCell(cell, code);; ++i) {
    const uint slot = (i & lists.slot_mask) * 6u;
    if (slots[slot + 3u] < 0) return uvec2(0u);
    if (slots[slot + 3u] == code && ivec3(slots[slot], slots[slot + 1u], slots[slot + 2u]) == cell) {
      return uvec2(slots[slot + 4u], slots[slot + 4u] + slots[slot + 5u]);
    }
  }
}

int facingOf(vec3 normal) {
  const vec3 n = abs(normal);
  const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  return axis * 2 + (normal[axis] < 0.0 ? 1 : 0);
}

// xy: from an entry to an end; z: part of a cell. From the first entry on that that reaches a part of the cell.
uint seek(uint first, uint end, uint part) {
  const uint word = 2u + part / 32u, bit = 1u << (part & 31u);
  bool found = false;
  while (first < end && !found) {
    found = (entries[first * 4u + word] & bit) != 0u;
    if (!found) ++first;
  }
  return first;
}

struct Sum {
  vec3 color;
  float through;  // T
  float alphas;
  float weight;  // of the owner
  uint owner;
};

void add(inout Sum sum, uint record, uint word, vec3 from_camera, vec3 normal) {
  const Shot shot = shots[record];
  const vec3 origin = vec3(shot.cell - lists.camera_cell.xyz) + (shot.fraction - lists.camera_fraction.xyz);
  const vec3 q = from_camera - origin;
  const float along = dot(q, shot.direction);
  const float across = length(cross(q, shot.direction));
  if (along < 0.0 || across >= shot.range || dot(q, normal) >= 0.0) return;
  if (!inSight(shot, word, q, along, normal)) return;
  const float alpha = min(1.0, lists.camera_fraction.w / max(across, 1e-6));
  const float fade = min(1.0, (1.0 - across / shot.range) * lists.per_fade);
  const float weight = alpha * sum.through;
  const vec2 blue_times = unpackHalf2x16(shot.color_b_times);
  sum.color += weight * vec3(unpackHalf2x16(shot.color_rg), blue_times.x);
  sum.alphas += alpha * fade * blue_times.y;
  sum.through *= 1.0 - alpha;
  if ((kWanted & 4u) != 0u && weight > sum.weight) {
    sum.weight = weight;
    sum.owner = shot.number;
  }
}

// The pixel's list on a level, as seek() takes it.
uvec3 listOn(uint level, vec3 from_camera, int facing) {
  const vec3 place = from_camera * lists.level_fraction[level].w + lists.level_fraction[level].xyz;
  const vec3 whole = floor(clamp(place, -1e9, 1e9));
  const uvec3 in_cell = uvec3(clamp((place - whole) * 4.0, 0.0, 3.0));
  const uint part = in_cell.x | in_cell.y << 2 | in_cell.z << 4;
  const uvec2 run = find(lists.level_cell[level].xyz + ivec3(whole), lists.level_cell[level].w + facing);
  return uvec3(seek(run.x, run.y, part), run.y, part);
}

bool isOpen(Sum sum, float enough) { return sum.through >= 1.0 / 512.0 || sum.alphas < enough; }

void walkOne(inout Sum sum, float enough, vec3 from_camera, vec3 normal) {
  uvec3 left = listOn(0u, from_camera, facingOf(normal));
  while (left.x < left.y && isOpen(sum, enough)) {
    add(sum, entries[left.x * 4u], entries[left.x * 4u + 1u], from_camera, normal);
    left.x = seek(left.x + 1u, left.y, left.z);
  }
}

// Levels differ in range, not in time: their lists are merged by the shots' numbers.
void walkAll(inout Sum sum, float enough, vec3 from_camera, vec3 normal) {
  uvec3 left[kLevels];
  uint live = 0u;
  for (uint i = 0u; i < uint(lists.camera_cell.w); ++i) {
    const uvec3 list = listOn(i, from_camera, facingOf(normal));
    if (list.x < list.y) left[live++] = list;
  }
  while (live > 0u && isOpen(sum, enough)) {
    uint newest = 0u, record = entries[left[0].x * 4u];
    for (uint i = 1u; i < live; ++i) {
      const uint other = entries[left[i].x * 4u];
      if (shots[other].number > shots[record].number) {
        record = other;
        newest = i;
      }
    }
    add(sum, record, entries[left[newest].x * 4u + 1u], from_camera, normal);
    left[newest].x = seek(left[newest].x + 1u, left[newest].y, left[newest].z);
    if (left[newest].x >= left[newest].y) left[newest] = left[--live];
  }
}

// Of a place `from_camera` metres from the camera, world axes, on a facet with this normal. Once the
// alphas add up to `enough` they may stop.
Sum walk(vec3 from_camera, vec3 normal, float enough) {
  Sum sum = Sum(vec3(0.0), 1.0, 0.0, 0.0, 0u);
  if (kOneLevel) {
    walkOne(sum, enough, from_camera, normal);
  } else {
    walkAll(sum, enough, from_camera, normal);
  }
  return sum;
}
