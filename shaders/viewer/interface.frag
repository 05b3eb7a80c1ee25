#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(TEXTURE(0)) uniform sampler2D glyphs;  // r: coverage; pictures: sRGB colours
layout(constant_id = 0) const bool pictures = false;
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 result;

void main() {
  const vec4 texel = texture(glyphs, uv);
  result = pictures ? color * texel : vec4(color.rgb, color.a * texel.r);
}
