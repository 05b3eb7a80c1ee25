#version 460
// SPDX-License-Identifier: MIT
// Visibility for each colour channel, with interreflections between surfaces of the pixel's base
// colour: bounced() of finish.glsl, with the base colour as the albedo.
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"
#include "finish.glsl"

layout(constant_id = 0) const bool kColoured = true;  // false: copies the visibility

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D visibility;
layout(TEXTURE(1)) uniform sampler2D base_colour;  // any texture unless kColoured
layout(IMAGE(0), rgba16f) writeonly uniform image2D tint;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(tint)))) return;
  const vec2 at = vec2(pixel) + 0.5;
  const float open = textureLod(visibility, at * view.size.zw, 0.0).x;
  const vec3 albedo = textureLod(base_colour, attachmentAt(at), 0.0).rgb;
  imageStore(tint, pixel, vec4(kColoured ? bounced(vec4(open), vec4(albedo, 0.0)).rgb : vec3(open), 1.0));
}
