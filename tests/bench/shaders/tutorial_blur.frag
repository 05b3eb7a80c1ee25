#version 460
// SPDX-License-Identifier: MIT
// The mean of 4 x 4 texels: one tile of the noise.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(location = 0) in vec2 tex_coord;
layout(location = 0) out float blurred;

layout(TEXTURE(0)) uniform sampler2D visibility;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(visibility, 0));
  float sum = 0.0;
  for (int x = -2; x < 2; ++x) {
    for (int y = -2; y < 2; ++y) {
      sum += texture(visibility, tex_coord + vec2(float(x), float(y)) * texel).x;
    }
  }
  blurred = sum / 16.0;
}
