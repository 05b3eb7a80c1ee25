#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#define FIRST 1
#define ACCESS writeonly
#include "per_shot.glsl"
