// SPDX-License-Identifier: MIT
// Conventions of the host program's textures. Pixels have their origin at the top left.
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform Source {
  mat4 world_from_view;  // rotation
  vec4 view_from_pixel;  // as in common/view.glsl
  // xy: of a depth buffer, with t the reversed value: view depth = x / (t + y), orthographic
  // t x + y. z: depth from which on is sky, metres; w: added to depths in metres.
  vec4 depth;
  vec4 planes;           // near plane, far plane of an orthographic camera, metres
  ivec4 mode;            // x: depth kind; y: 1: orthographic; z: 1: rows from the bottom; w: flags
} source;

const int kUnsigned = 1, kInView = 2;  // flags of normals
const int kBuffer = 0, kView = 1, kDistance = 2, kBufferReversed = 3;

bool orthographic() {
  return source.mode.y != 0;
}

// Texel of a pixel, in a texture of this height.
ivec2 texelOf(ivec2 pixel, int height) {
  return source.mode.z != 0 ? ivec2(pixel.x, height - 1 - pixel.y) : pixel;
}
