#version 460
// SPDX-License-Identifier: MIT
// Spreads the reach of tiles (reach.comp) along rows, then along columns. A tile of the result is
// over 0 if it lies within the reach of a tile, in rows and in columns.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(constant_id = 0) const bool kColumn = false;

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D reach;  // nearest, clamped
layout(IMAGE(0), r32f) writeonly uniform image2D target;

void main() {
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target);
  if (any(greaterThanEqual(tile, size))) return;
  ivec2 along = ivec2(1, 0);
  if (kColumn) along = along.yx;
  const int count = kColumn ? size.y : size.x, own = kColumn ? tile.y : tile.x;
  float most = 0.0;
  for (int i = 0; i < count; ++i) {
    const vec2 other = vec2(tile + along * (i - own)) + 0.5;
    const float reached = textureLod(reach, other / vec2(size), 0.0).x;
    most = reached >= float(abs(i - own)) ? max(most, reached) : most;
  }
  imageStore(target, tile, vec4(most));
}
