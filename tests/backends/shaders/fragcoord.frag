// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(location = 0) out vec4 color;

void main() { color = vec4(gl_FragCoord.xyz, gl_FrontFacing ? 1.0 : -1.0); }
