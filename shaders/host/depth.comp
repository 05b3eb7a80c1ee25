#version 460
// SPDX-License-Identifier: MIT
// Converts the host's depth texture, of any kind, to linear view depth in metres; sky: 0.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D depths;
layout(IMAGE(0), r32f) writeonly uniform image2D view_depth;

// View depth from a depth buffer's value, 1 at the near plane; sky: 0.
float ofBuffer(float reversed) {
  if (!(reversed > 0.0)) return 0.0;
  if (orthographic()) return reversed * source.depth.x + source.depth.y;
  const float below = reversed + source.depth.y;
  return below > 0.0 ? source.depth.x / below : 0.0;
}

// View depth from metres; sky: 0. An orthographic camera may have surfaces at and behind its eye.
float ofMetres(float metres) {
  const bool surface = metres > 0.0 || source.depth.w > 0.0;
  return surface && metres < source.depth.z ? metres + source.depth.w : 0.0;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, source.place.zw))) return;
  const float given = texelFetch(depths, texelOf(pixel), 0).x;
  float metres = 0.0;
  if (source.mode.x == kBuffer) metres = ofBuffer(1.0 - given);
  if (source.mode.x == kBufferReversed) metres = ofBuffer(given);
  if (source.mode.x == kView) metres = ofMetres(given);
  if (source.mode.x == kDistance) {
    const vec2 ray = (vec2(pixel) + 0.5) * source.view_from_pixel.xy + source.view_from_pixel.zw;
    metres = ofMetres(given);
    if (!orthographic()) metres *= inversesqrt(1.0 + dot(ray, ray));
  }
  imageStore(view_depth, pixel, vec4(metres));
}
