#version 460
// SPDX-License-Identifier: MIT
// Converts the host program's motion vectors to GRISAILLE_MOTION. The change of view depth, and
// whether a surface moves in the world, follow from the cameras of both frames.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"
#include "common/motion.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Then {
  mat4 then_from_view;        // this frame's view space to the previous frame's
  vec4 then_pixel_from_view;  // of the previous camera, at this frame's size
  vec4 shift;                 // pixels of motion: xy * vector + zw
  float known;                // 0: no motion is known
  float then_orthographic;    // 1: the previous camera was orthographic
} then;
layout(TEXTURE(0)) uniform sampler2D vectors;     // xy: in the host's unit and row order
layout(TEXTURE(1)) uniform sampler2D view_depth;  // metres; 0: sky
layout(IMAGE(0), rgba16f) writeonly uniform image2D motion;

const float kSame = 0.1;  // pixels by which motion may differ from the camera's at rest

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, source.place.zw))) return;
  const float depth = texelFetch(view_depth, pixel, 0).x;
  vec4 result = vec4(0.0);
  if (depth > 0.0 && then.known > 0.0) {
    const vec2 at = vec2(pixel) + 0.5;
    const vec2 place = at * source.view_from_pixel.xy + source.view_from_pixel.zw;
    const vec3 now = vec3(place * (orthographic() ? 1.0 : depth), -depth);
    const vec3 before = (then.then_from_view * vec4(now, 1.0)).xyz;
    const float scale = then.then_orthographic > 0.0 ? 1.0 : -before.z;
    const vec2 resting =
        before.xy * (then.then_pixel_from_view.xy / scale) + then.then_pixel_from_view.zw - at;
    const vec2 moved = texelFetch(vectors, texelOf(pixel), 0).xy * then.shift.xy + then.shift.zw;
    const bool rests = distance(moved, resting) < kSame;
    result = motionOf(moved, -before.z, depth, rests ? kResting : kMoving);
  }
  imageStore(motion, pixel, result);
}
