// SPDX-License-Identifier: MIT
// One draw of the scene. Transforms are made in double precision relative to the camera, so that
// single precision holds far from the world's origin.
#include "common/bindings.glsl"

layout(UNIFORM(0), std140) uniform DrawBlock {
  mat4 clip_from_object;
  mat4 normal_from_object;  // to world axes; inverse transpose, in its upper 3x3
  vec4 base_color;          // linear
  float alpha_cutoff;
  float front_sign;         // -1 when the transform mirrors, so that "front" is the back
#if FACET
  mat4 camera_from_object;  // world axes, metres from the camera
#endif
} draw;
