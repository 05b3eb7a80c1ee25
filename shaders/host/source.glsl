// SPDX-License-Identifier: MIT
// Conventions of the host program's textures. Pixels have their origin at the top left.
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform Source {
  mat4 world_from_view;  // rotation
  vec4 view_from_pixel;  // pixel * .xy + .zw: view.xy at view depth 1, or of an orthographic camera
  vec4 planes;           // near, far; near / far, 0: infinite; depth from which on is sky; metres
  vec4 shift;            // metres: x: added to view depth; y: near plane of the effects' camera
  ivec4 mode;            // x: depth kind; y: 1: orthographic; z: 1: rows from the bottom; w: flags
} source;

const int kUnsigned = 1, kInView = 2;  // flags of normals
const int kClip = 0, kClipReversed = 1, kView = 2, kDistance = 3;

bool orthographic() {
  return source.mode.y != 0;
}

// Texel of a pixel, in a texture of this height.
ivec2 texelOf(ivec2 pixel, int height) {
  return source.mode.z != 0 ? ivec2(pixel.x, height - 1 - pixel.y) : pixel;
}
