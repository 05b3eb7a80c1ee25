#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#define FIRST 0
#define ACCESS
#include "per_shot.glsl"
