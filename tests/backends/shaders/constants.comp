// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(local_size_x = 1) in;
layout(constant_id = 0) const uint kUnsigned = 7;
layout(constant_id = 3) const int kSigned = -7;
layout(constant_id = 5) const float kReal = 0.25;
layout(constant_id = 9) const bool kFlag = false;
layout(STORAGE(0), std430) writeonly buffer Out { uint data[]; };

void main() {
  data[0] = kUnsigned;
  data[1] = uint(kSigned);
  data[2] = floatBitsToUint(kReal);
  data[3] = kFlag ? 1u : 0u;
}
