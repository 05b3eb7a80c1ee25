#version 460
// SPDX-License-Identifier: MIT
// Sums the squared differences of two textures of one size: one sum for each square of pixels.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

const uint kGroup = 16u;     // threads a side
const uint kSquare = 64u;    // pixels a side of a square
const uint kThreads = kGroup * kGroup;

layout(local_size_x = kGroup, local_size_y = kGroup) in;
layout(TEXTURE(0)) uniform sampler2D left_side;
layout(TEXTURE(1)) uniform sampler2D right_side;
layout(UNIFORM(0)) uniform Difference {
  uint channels;  // compared, 1 ... 4
} difference;
layout(STORAGE(0), std430) writeonly buffer Sums {
  vec4 sums[];  // sum of squares, number of compared values, largest difference, 0
};

shared vec3 parts[kThreads];

void main() {
  const ivec2 size = textureSize(left_side, 0);
  const ivec2 corner = ivec2(gl_WorkGroupID.xy * kSquare + gl_LocalInvocationID.xy);
  vec3 part = vec3(0.0);
  for (uint i = 0u; i < (kSquare / kGroup) * (kSquare / kGroup); ++i) {
    const ivec2 at = corner + ivec2(i % (kSquare / kGroup), i / (kSquare / kGroup)) * int(kGroup);
    if (any(greaterThanEqual(at, size))) continue;
    const vec2 uv = (vec2(at) + 0.5) / vec2(size);
    const vec4 a = textureLod(left_side, uv, 0.0), b = textureLod(right_side, uv, 0.0);
    for (uint c = 0u; c < difference.channels; ++c) {
      const float off = a[c] - b[c];
      if (isnan(off) || isinf(off)) continue;
      part += vec3(off * off, 1.0, 0.0);
      part.z = max(part.z, abs(off));
    }
  }
  parts[gl_LocalInvocationIndex] = part;
  barrier();
  for (uint half_ = kThreads / 2u; half_ > 0u; half_ /= 2u) {
    if (gl_LocalInvocationIndex < half_) {
      const vec3 other = parts[gl_LocalInvocationIndex + half_];
      part = vec3(part.xy + other.xy, max(part.z, other.z));
      parts[gl_LocalInvocationIndex] = part;
    }
    barrier();
  }
  if (gl_LocalInvocationIndex == 0u) {
    sums[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = vec4(part, 0.0);
  }
}
