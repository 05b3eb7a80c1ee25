// SPDX-License-Identifier: MIT
// List of the blocks of 2x2 pixels of which some are computed at full resolution although the effect's
// is lower. upsample.glsl writes it. Nobody knows its length when the frame is recorded: in the passes
// after it, few invocations process several blocks each.
layout(STORAGE(0), std430) buffer List {
  uint count;  // of blocks; may exceed the room: the rest keeps its upsampled value
  uint listed[];
};

// A byte for each of the pixels (0, 0), (1, 0), (0, 1) and (1, 1), from the lowest bits on.
struct Block {
  ivec2 place;  // its first pixel
  uint open;    // visibilities after the upsampling, before finished()
  uint shares;  // how much of them the refined pixels replace; 0 for pixels that are not refined
};

void append(Block block) {
  const uint i = 3u * atomicAdd(count, 1u);
  if (i + 3u > uint(listed.length())) return;
  listed[i] = uint(block.place.x) | uint(block.place.y) << 16;
  listed[i + 1u] = block.open;
  listed[i + 2u] = block.shares;
}

Block blockAt(uint i) {
  const uint place = listed[3u * i];
  return Block(ivec2(place & 0xffffu, place >> 16), listed[3u * i + 1u], listed[3u * i + 2u]);
}

// The blocks of an invocation: from the first to the end of the list, by the stride. For groups of 8x8.
uint firstBlock() {
  return gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
}
uint blockStride() {
  return gl_NumWorkGroups.x * 64u;
}
uint blockEnd() {
  return min(count, uint(listed.length()) / 3u);
}
