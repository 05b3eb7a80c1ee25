#version 460
// SPDX-License-Identifier: MIT
// Writes runs of words to an array.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 64) in;
layout(STORAGE(0), std430) readonly buffer Changes {
  uint words;       // of the payload
  uint runs;
  uint first_word;  // of the payload, in `payload`
  uint unused;
  uvec2 run[];      // x: the run's first word in the payload, ascending from 0; y: in the array
};
layout(STORAGE(1), std430) readonly buffer Payload { uint payload[]; };
layout(STORAGE(2), std430) writeonly buffer Array { uint array[]; };

void main() {
  for (uint i = gl_GlobalInvocationID.x; i < words; i += gl_NumWorkGroups.x * 64u) {
    // The last run that starts at i or before.
    uint low = 0u, high = runs;
    while (high - low > 1u) {
      const uint middle = (low + high) / 2u;
      if (run[middle].x <= i) {
        low = middle;
      } else {
        high = middle;
      }
    }
    array[run[low].y + (i - run[low].x)] = payload[first_word + i];
  }
}
