#version 460
// SPDX-License-Identifier: MIT
// Motion of a surface that moves in the world, where it is the visible one.
#extension GL_GOOGLE_include_directive : require
#include "motion_draw.glsl"
#include "common/motion.glsl"

layout(location = 0) in vec4 now;  // clip x, y, w; view depth
layout(location = 1) in vec4 then;
layout(TEXTURE(0)) uniform sampler2D front;  // clip depth
layout(location = 0) out vec4 motion;

void main() {
  // Fragments in the holes of a mask are nearer than the visible surface, hidden ones are farther.
  const float visible = texelFetch(front, ivec2(gl_FragCoord.xy), 0).x;
  if (abs(gl_FragCoord.z - visible) > 1e-6 * visible) discard;
  motion = motionOf((then.xy / then.z - now.xy / now.z) * draw.pixels_from_clip, then.w, now.w,
                    kMoving);
}
