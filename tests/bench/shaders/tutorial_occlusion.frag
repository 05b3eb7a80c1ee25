#version 460
// SPDX-License-Identifier: MIT
// Ambient occlusion as tutorials teach it: the baseline for the effect's cost. It has no
// optimisation beyond the tutorials'.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(location = 0) in vec2 tex_coord;
layout(location = 0) out float visibility;

layout(UNIFORM(0), std140) uniform Tutorial {
  mat4 projection;  // clip from view, with y flipped to the direction of texture rows
  vec4 kernel[64];  // xyz in tangent space, within the unit hemisphere about +z
  vec4 repeats_lengths;  // xy: number of noise tiles across the screen; radius and bias, metres
} tutorial;

layout(TEXTURE(0)) uniform sampler2D positions;  // view space, metres
layout(TEXTURE(1)) uniform sampler2D normals;    // view space, unit
layout(TEXTURE(2)) uniform sampler2D noise;      // rotations about z, tiled

const int kKernelSize = 64;

void main() {
  vec3 position = texture(positions, tex_coord).xyz;
  vec3 normal = normalize(texture(normals, tex_coord).xyz);
  vec3 rotation = normalize(texture(noise, tex_coord * tutorial.repeats_lengths.xy).xyz);
  vec3 tangent = normalize(rotation - normal * dot(rotation, normal));
  mat3 view_from_tangent = mat3(tangent, cross(normal, tangent), normal);

  float radius = tutorial.repeats_lengths.z, bias = tutorial.repeats_lengths.w;
  float occlusion = 0.0;
  for (int i = 0; i < kKernelSize; ++i) {
    vec3 point = position + view_from_tangent * tutorial.kernel[i].xyz * radius;
    vec4 clip = tutorial.projection * vec4(point, 1.0);
    vec3 seen = clip.xyz / clip.w * 0.5 + 0.5;
    float z = texture(positions, seen.xy).z;
    float in_range = smoothstep(0.0, 1.0, radius / abs(position.z - z));
    occlusion += (z >= point.z + bias ? 1.0 : 0.0) * in_range;
  }
  visibility = 1.0 - occlusion / float(kKernelSize);
}
