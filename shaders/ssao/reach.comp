#version 460
// SPDX-License-Identifier: MIT
// Tiles of 16x16 pixels: how far moving surfaces in a tile can change the visibility of others. A
// surface changes what lies within the radius of its place, now or in the previous frame.
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  float radius;  // metres
} settings;
layout(TEXTURE(0)) uniform sampler2D motion;      // nearest, clamped
layout(TEXTURE(1)) uniform sampler2D view_depth;
// Distance in tiles, 0: nothing moves. Tiles begin at the attachments' corner.
layout(IMAGE(0), r32f) writeonly uniform image2D target;

const int kTile = 16, kStep = 2;  // pixels; reads one of kStep x kStep

void main() {
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, imageSize(target)))) return;
  float most = -1.0;  // pixels
  for (int i = 0; i < kTile * kTile / (kStep * kStep); ++i) {
    const ivec2 texel = tile * kTile + kStep * ivec2(i % (kTile / kStep), i / (kTile / kStep));
    const vec2 place = (vec2(texel) + 0.5) * view.attachment.zw;
    const vec4 moved = textureLod(motion, place, 0.0);
    const float depth = textureLod(view_depth, place, 0.0).x;
    // Surfaces within the radius may be nearer to the camera, where it spans more pixels.
    const float nearest = max(depth - settings.radius, 0.25 * depth);
    const float reach = settings.radius * abs(view.pixel_from_view.x) / depthScale(max(nearest, 1e-30));
    most = moved.w > 1.5 ? max(most, reach + length(moved.xy)) : most;
  }
  imageStore(target, tile, vec4(most >= 0.0 ? min(most / float(kTile), 1e4) + 1.0 : 0.0));
}
