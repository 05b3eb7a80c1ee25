// SPDX-License-Identifier: MIT
// List of the pixels that are computed at full resolution although the effect's is lower.
// upsample.glsl writes it. Nobody knows its length when the frame is recorded: in the passes after
// it, few invocations process several pixels each.
layout(STORAGE(0), std430) buffer List {
  uint listed_count;  // may exceed the length of `listed`; the rest keeps its upsampled value
  uint listed[];      // x | y << 16
};

// Byte of a listed pixel in the image `blocks`, see upsample.glsl.
const uint kIsListed = 255u;

ivec2 listedPixel(uint i) {
  return ivec2(listed[i] & 0xffffu, listed[i] >> 16);
}

// First index of an invocation, number of invocations, and end of the list. For groups of 8x8.
uint listedFirst() {
  return gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex;
}
uint listedStride() {
  return gl_NumWorkGroups.x * 64u;
}
uint listedEnd() {
  return min(listed_count, uint(listed.length()));
}
