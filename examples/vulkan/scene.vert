#version 460
// SPDX-License-Identifier: MIT
layout(push_constant) uniform Camera {
  mat4 clip_from_world;
} camera;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 world_normal;

void main() {
  gl_Position = camera.clip_from_world * vec4(position, 1.0);
  world_normal = normal;
}
