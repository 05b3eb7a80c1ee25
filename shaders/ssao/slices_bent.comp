#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#define BENT 1
#define LISTED 0
#include "slices.glsl"
