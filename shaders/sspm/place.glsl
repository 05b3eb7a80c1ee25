// SPDX-License-Identifier: MIT
// World-space position of a pixel.
#include "common/view.glsl"

// Position of a pixel's surface relative to the camera, world axes, metres.
vec3 fromCamera(vec2 pixel, float view_depth) {
  return transpose(mat3(view.view_from_world)) * viewPosition(pixel, view_depth);
}
