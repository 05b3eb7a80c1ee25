#version 460
// SPDX-License-Identifier: MIT
// Reconstructs facet normals from depth, as unit world normals.
#extension GL_GOOGLE_include_directive : require
#include "source.glsl"

vec3 viewPosition(vec2 pixel, float view_depth) {
  const vec2 ray = pixel * source.view_from_pixel.xy + source.view_from_pixel.zw;
  return vec3(orthographic() ? ray : ray * view_depth, -view_depth);
}

#include "scene/facet_normal.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(IMAGE(0), rgba16f) writeonly uniform image2D world_normal;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(world_normal)))) return;
  const vec4 normal = facetNormal(pixel);
  imageStore(world_normal, pixel, vec4(mat3(source.world_from_view) * normal.xyz, normal.w));
}
