#version 460
// SPDX-License-Identifier: MIT
// Composes a picture in linear light: surface colour, with an overlay over it, times visibility. An
// unused slot holds a 1x1 texture of the neutral value: white surface, transparent overlay,
// visibility 1.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(constant_id = 0) const bool kTinted = false;  // visibility per colour channel, in rgb

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D surface;     // rgb; a = 0: sky, which is white
layout(TEXTURE(1)) uniform sampler2D overlay;     // straight alpha
layout(TEXTURE(2)) uniform sampler2D visibility;  // r, or rgb
layout(IMAGE(0), rgba16f) writeonly uniform image2D color;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(color);
  if (any(greaterThanEqual(pixel, size))) return;
  const vec2 uv = (vec2(pixel) + 0.5) / vec2(size);
  const vec4 base = textureLod(surface, uv, 0.0);
  const vec4 over = textureLod(overlay, uv, 0.0);
  vec3 light = base.a > 0.0 ? base.rgb : vec3(1.0);
  const vec3 open = textureLod(visibility, uv, 0.0).rgb;
  light = mix(light, over.rgb, over.a) * (kTinted ? open : open.rrr);
  imageStore(color, pixel, vec4(light, 1.0));
}
