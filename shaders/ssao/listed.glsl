// SPDX-License-Identifier: MIT
// Lists of the pixels that are computed at full resolution although the effect's is lower, and of the
// blocks of 2x2 pixels that hold one. upsample.glsl writes them. Nobody knows their lengths when the
// frame is recorded: in the passes after it, few invocations process several entries each.
layout(STORAGE(0), std430) buffer List {
  // Numbers of entries. They may exceed the room: the rest keeps its upsampled value.
  uint pixel_count, block_count;
  uint listed[];  // x | y << 16: pixels from the front on, blocks from the back
};

// Byte of a listed pixel in the image `blocks`, see upsample.glsl.
const uint kIsListed = 255u;

uint blockRoom() {
  return uint(listed.length()) / 5u;
}
uint pixelRoom() {
  return uint(listed.length()) - blockRoom();
}

ivec2 placeOf(uint entry) {
  return ivec2(entry & 0xffffu, entry >> 16);
}
ivec2 listedPixel(uint i) {
  return placeOf(listed[i]);
}
ivec2 listedBlock(uint i) {
  return placeOf(listed[uint(listed.length()) - 1u - i]);
}

// First entry of an invocation, and number of invocations. For groups of 8x8.
uint listedFirst() {
  return gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
}
uint listedStride() {
  return gl_NumWorkGroups.x * 64u;
}
