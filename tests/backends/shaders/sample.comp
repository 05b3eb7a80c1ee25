// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

// Samples a texture at given places: xy are texture coordinates, z is the level.
layout(local_size_x = 64) in;
layout(TEXTURE(0)) uniform sampler2D source;
layout(STORAGE(0), std430) readonly buffer Places { vec4 places[]; };
layout(STORAGE(1), std430) writeonly buffer Out { vec4 samples[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < places.length()) samples[i] = textureLod(source, places[i].xy, places[i].z);
}
