// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(location = 0) out vec4 first;
layout(location = 1) out float second;
layout(location = 2) out uint third;

void main() {
  first = vec4(0.25, 0.5, 0.75, 1.0);
  second = gl_FragCoord.x;
  third = uint(gl_FragCoord.y);
}
