#version 460
// SPDX-License-Identifier: MIT
// Converts the host's normals, of either space and encoding, to unit world normals; sky: 0.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

// Octahedral encoding: Meyer et al. 2010, "On Floating-Point Normal Vectors".
vec3 ofOctahedron(vec2 at) {
  vec3 normal = vec3(at, 1.0 - abs(at.x) - abs(at.y));
  const float below = max(-normal.z, 0.0);
  normal.x += normal.x >= 0.0 ? -below : below;
  normal.y += normal.y >= 0.0 ? -below : below;
  return normal;
}

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D normals;
layout(TEXTURE(1)) uniform sampler2D view_depth;
layout(IMAGE(0), rgba16f) writeonly uniform image2D world_normal;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, source.place.zw))) return;
  vec4 result = vec4(0.0);
  if (texelFetch(view_depth, pixel, 0).x > 0.0) {
    vec3 normal = texelFetch(normals, texelOf(pixel), 0).xyz;
    if ((source.mode.w & kUnsigned) != 0) normal = 2.0 * normal - 1.0;
    if ((source.mode.w & kOctahedral) != 0) normal = ofOctahedron(normal.xy);
    if ((source.mode.w & kInView) != 0) normal = mat3(source.world_from_view) * normal;
    // Keeps normals that have unit length to the precision of half floats.
    const float length = length(normal);
    if (abs(length - 1.0) > 0.002) normal = length > 0.0 ? normal / length : vec3(0.0);
    result = vec4(normal, 1.0);
  }
  imageStore(world_normal, pixel, result);
}
