#version 460
// SPDX-License-Identifier: MIT
// Writes the buffers that tutorials expect: view-space positions and normals. The sky is a distant
// plane that faces the camera: it neither occludes nor is occluded.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(location = 0) in vec2 tex_coord;
layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;

layout(UNIFORM(0), std140) uniform Inputs {
  mat4 rotation;  // view from world axes
  vec4 tangents;  // xy: half the view's width and height at view depth 1
} inputs;

layout(TEXTURE(0)) uniform sampler2D view_depth;  // metres; sky: 0
layout(TEXTURE(1)) uniform sampler2D world_normal;

const float kSkyDepth = 1000.0;  // metres

void main() {
  float z = texture(view_depth, tex_coord).x;
  bool sky = z == 0.0;
  if (sky) z = kSkyDepth;
  vec2 ray = vec2(tex_coord.x * 2.0 - 1.0, 1.0 - tex_coord.y * 2.0) * inputs.tangents.xy;
  position = vec4(ray * z, -z, 1.0);
  vec3 n = mat3(inputs.rotation) * texture(world_normal, tex_coord).xyz;
  normal = vec4(sky ? vec3(0.0, 0.0, 1.0) : n, 0.0);
}
