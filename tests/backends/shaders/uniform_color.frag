// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform Paint { vec4 paint; };
layout(location = 0) out vec4 color;

void main() { color = paint; }
