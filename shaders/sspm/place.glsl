// SPDX-License-Identifier: MIT
// Where a pixel is.
#include "common/view.glsl"

// A pixel's place in world axes from the camera, metres.
vec3 fromCamera(vec2 pixel, float view_depth) {
  return transpose(mat3(view.view_from_world)) * viewPosition(pixel, view_depth);
}
