#version 460
// SPDX-License-Identifier: MIT
// Composes a picture in linear light: surface colour, with an overlay over it, times visibility.
// The background takes the place of the surface where there is none. Alpha is straight. An unused
// slot holds a 1x1 texture of the neutral value: white surface, transparent overlay, visibility 1,
// and a depth of 1, so that the surface's own alpha counts.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(constant_id = 0) const bool kTinted = false;  // visibility per colour channel, in rgb

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D surface;
layout(TEXTURE(1)) uniform sampler2D overlay;     // straight alpha
layout(TEXTURE(2)) uniform sampler2D visibility;  // r, or rgb
layout(TEXTURE(3)) uniform sampler2D clip_depth;  // r; 0: no surface
layout(IMAGE(0), rgba16f) writeonly uniform image2D color;
layout(UNIFORM(0)) uniform Compose {
  vec4 background;  // linear light, straight alpha
  vec4 depth;       // xy: guard band of the depth, pixels; zw: 1 / size of the depth, 1 / pixels
} compose;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(color);
  if (any(greaterThanEqual(pixel, size))) return;
  const vec2 centre = vec2(pixel) + 0.5;
  const vec2 uv = centre / vec2(size);
  const vec2 depth_uv = (centre + compose.depth.xy) * compose.depth.zw;
  const bool there = textureLod(clip_depth, depth_uv, 0.0).r > 0.0;
  const vec4 base = there ? textureLod(surface, uv, 0.0) : compose.background;
  const vec4 over = textureLod(overlay, uv, 0.0);
  const vec3 open = textureLod(visibility, uv, 0.0).rgb;
  const float alpha = base.a + over.a * (1.0 - base.a);
  // The share of the overlay in a pixel that the surface does not fill.
  const float share = alpha > 0.0 ? over.a / alpha : 0.0;
  const vec3 light = mix(base.rgb, over.rgb, share) * (kTinted ? open : open.rrr);
  imageStore(color, pixel, vec4(light, alpha));
}
