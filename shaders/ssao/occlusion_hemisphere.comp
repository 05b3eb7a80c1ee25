#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#define SPHERE 0
#include "occlusion.glsl"
