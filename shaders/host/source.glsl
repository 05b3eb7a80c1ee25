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
  ivec4 place;           // xy: texel of the picture's corner in the textures; zw: picture's size
} source;

const int kUnsigned = 1, kInView = 2, kOctahedral = 4;  // flags of normals
const int kBuffer = 0, kView = 1, kDistance = 2, kBufferReversed = 3;

bool orthographic() {
  return source.mode.y != 0;
}

// Texel of a pixel in the host program's textures.
ivec2 texelOf(ivec2 pixel) {
  const int row = source.mode.z != 0 ? source.place.w - 1 - pixel.y : pixel.y;
  return source.place.xy + ivec2(pixel.x, row);
}
