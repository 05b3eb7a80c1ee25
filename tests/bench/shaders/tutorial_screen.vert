#version 460
// SPDX-License-Identifier: MIT
// One triangle that covers the screen.

layout(location = 0) out vec2 tex_coord;

void main() {
  vec2 corner = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
  tex_coord = vec2(corner.x, 1.0 - corner.y);
  gl_Position = vec4(corner * 2.0 - 1.0, 0.5, 1.0);
}
