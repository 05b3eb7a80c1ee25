// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(location = 0) in vec3 position;

void main() { gl_Position = vec4(position, 1.0); }
