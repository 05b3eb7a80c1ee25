// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// Like sample.comp, with the layer in w.
layout(local_size_x = 64) in;
layout(TEXTURE(0)) uniform sampler2DArray source;
layout(STORAGE(0), std430) readonly buffer Places { vec4 places[]; };
layout(STORAGE(1), std430) writeonly buffer Out { vec4 samples[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < places.length()) samples[i] = textureLod(source, places[i].xyw, places[i].z);
}
