// SPDX-License-Identifier: MIT
// Uniforms of one draw of the scene. The host computes the transforms relative to the camera in
// double precision, so that single precision suffices far from the world's origin.
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform DrawBlock {
  mat4 clip_from_object;
  mat4 normal_from_object;  // to world axes: inverse transpose, in the upper 3x3
  vec4 base_color;          // linear
  float alpha_cutoff;
  float front_sign;         // -1 if the transform mirrors, which swaps front and back; else 1
  float chord_scale;        // on the thickness of matter
#if FACET
  mat4 camera_from_object;  // world axes, metres from the camera
  vec4 sight;               // away from the camera: .xyz + .w * position from the camera
#endif
} draw;
