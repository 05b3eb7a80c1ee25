#version 460
// SPDX-License-Identifier: MIT
// Motion of surfaces that rest in the world: the camera alone moves them in the picture. See
// GRISAILLE_MOTION of grisaille/effect.h. Surfaces that move are drawn over the result.
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "common/motion.glsl"

layout(UNIFORM(1), std140) uniform Then {
  mat4 then_from_view;        // this frame's view space to the previous frame's
  vec4 then_pixel_from_view;  // of the previous camera, at this frame's size
  float known;                // 0: no motion is known
  float camera_moved;         // 0: the camera is that of the previous frame
  float then_orthographic;    // 1: the previous camera was orthographic
} then;
layout(TEXTURE(0)) uniform sampler2D clip_depth;
layout(location = 0) out vec4 motion;

void main() {
  const float clip = textureLod(clip_depth, gl_FragCoord.xy * view.attachment.zw, 0.0).x;
  motion = vec4(0.0);
  if (clip > 0.0 && then.known > 0.0) {
    motion.w = kResting;
    if (then.camera_moved > 0.0) {
      const vec2 pixel = gl_FragCoord.xy - view.attachment.xy;
      const vec3 now = viewPosition(pixel, viewDepthOf(clip));
      const vec3 before = (then.then_from_view * vec4(now, 1.0)).xyz;
      const float scale = then.then_orthographic > 0.0 ? 1.0 : -before.z;
      const vec2 from =
          before.xy * (then.then_pixel_from_view.xy / scale) + then.then_pixel_from_view.zw;
      motion = motionOf(from - pixel, -before.z, -now.z, kResting);
    }
  }
}
