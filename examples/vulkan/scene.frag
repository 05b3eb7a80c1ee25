#version 460
// SPDX-License-Identifier: MIT
layout(location = 0) in vec3 world_normal;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 normal;

void main() {
  normal = vec4(normalize(world_normal), 0.0);
  // A distant lamp, and ambient light from the sky.
  const float lamp = max(dot(normal.xyz, normalize(vec3(0.5, 0.9, 0.4))), 0.0);
  colour = vec4(vec3(0.25) * lamp + vec3(0.5), 1.0);
}
