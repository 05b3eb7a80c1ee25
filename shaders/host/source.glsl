// SPDX-License-Identifier: MIT
// How the textures of another program are to be read. Pixels have their origin at the top left.
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform Source {
  mat4 world_from_view;  // rotation
  vec4 view_from_pixel;  // view.xy, at view depth 1 or of an orthographic camera = pixel * .xy + .zw
  vec4 planes;           // metres: near, far; near / far, 0 when infinitely far; sky from so many metres
  vec4 shift;            // metres: .x is added to view depth, .y: near plane of what effects see
  ivec4 mode;            // depth kind; 1: orthographic; 1: rows from the bottom; flags of normals
} source;

const int kUnsigned = 1, kInView = 2;  // flags of normals
const int kClip = 0, kClipReversed = 1, kView = 2, kDistance = 3;

bool orthographic() {
  return source.mode.y != 0;
}

// The texel that holds a pixel.
ivec2 texelOf(ivec2 pixel, int height) {
  return source.mode.z != 0 ? ivec2(pixel.x, height - 1 - pixel.y) : pixel;
}
