// SPDX-License-Identifier: MIT
// Settings that both passes share.
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 light;        // xyz: unit vector towards the light, view space
  float reach;       // of the rays, metres
  float thickness;   // of what the camera sees, metres
  float steps;
  float strength;    // share of the light that a shadow keeps off
  float frames;      // that the history averages
  uint index;        // of the frame
  uint remembers;    // 1: there is a history
  uint has_ao;       // 1: another effect's visibility is known
} settings;
