#version 460
// SPDX-License-Identifier: MIT
// Reads the depth buffer at single texels, for the pointer: reading all of it back would take
// milliseconds.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

const uint kMost = 16u;

layout(local_size_x = kMost) in;
layout(TEXTURE(0)) uniform sampler2D clip_depth;
layout(UNIFORM(0)) uniform Places {
  ivec4 texels[kMost];  // xy
} places;
layout(STORAGE(0), std430) writeonly buffer Depths {
  float depths[kMost];  // near plane / view depth; 0: sky
};

void main() {
  const uint i = gl_LocalInvocationIndex;
  const vec2 texel = vec2(places.texels[i].xy) + 0.5;
  depths[i] = textureLod(clip_depth, texel / vec2(textureSize(clip_depth, 0)), 0.0).r;
}
