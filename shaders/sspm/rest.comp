#version 460
// SPDX-License-Identifier: MIT
// Mode `surface` below full resolution, third pass: walks the lists of the pixels that
// upsample.comp has put on its list. Each of few threads processes many pixels: on a software
// driver, an idle thread costs as much as a busy one.
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"
#include "outputs.glsl"
#include "walk.glsl"

layout(local_size_x = 64) in;
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
layout(STORAGE(4), std430) readonly buffer Rest {
  uint rest_count;
  uint rest[];
};

void main() {
  for (uint i = gl_GlobalInvocationID.x; i < rest_count; i += gl_NumWorkGroups.x * 64u) {
    const ivec2 pixel = ivec2(rest[i] & 0xffffu, rest[i] >> 16);
    const vec2 at = vec2(pixel) + 0.5;
    const vec2 uv = at * view.size.zw;
    const float depth = textureLod(view_depth, uv, 0.0).x;
    const vec3 normal = textureLod(facet_normal, uv, 0.0).xyz;
    uint blocked;
    Sum sum = walk(Point(fromCamera(at, depth), normal, pixelSize(depth)), (kWanted & 2u) != 0u, blocked);
    if ((kWanted & 4u) != 0u) sum.owner = numberOf(sum.owner);
    writePaint(pixel, sum);
  }
}
