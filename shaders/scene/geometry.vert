#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

layout(location = 0) in vec3 position;
#if NORMAL
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 world_normal;
#endif
#if UV
layout(location = 2) in vec2 tex_coord;
layout(location = 1) out vec2 uv;
#endif
#if COLOUR
layout(location = 3) in vec4 vertex_colour;
layout(location = 3) out vec4 colour;
#endif
#if THICKNESS
layout(location = 4) in float thickness;  // units of the object; -1: unknown
layout(location = 4) out float matter;    // metres; -1: unknown
#endif
#if FACET
layout(location = 2) out vec3 from_camera;
#endif

// Same position in all variants of this shader, so that a second pass over the geometry has equal
// depth.
invariant gl_Position;

void main() {
  gl_Position = draw.clip_from_object * vec4(position, 1.0);
#if NORMAL
  world_normal = mat3(draw.normal_from_object) * normal;
#endif
#if UV
  uv = tex_coord;
#endif
#if COLOUR
  colour = vertex_colour;
#endif
#if THICKNESS
  matter = thickness < 0.0 ? -1.0 : thickness * draw.chord_scale;
#endif
#if FACET
  from_camera = (draw.camera_from_object * vec4(position, 1.0)).xyz;
#endif
}
