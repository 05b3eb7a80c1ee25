#version 460
// SPDX-License-Identifier: MIT
// Mode `surface` below full resolution, first pass: walks the lists of every kStep-th pixel of a
// row and a column, and of the last pixel of each. upsample.comp interpolates the other pixels from
// these samples.
#extension GL_GOOGLE_include_directive : require
#include "place.glsl"

layout(constant_id = 0) const uint kWanted = 7;  // see outputs.glsl
#include "walk.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const uint kStep = 2;  // pixels
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
layout(IMAGE(0), rgba16f) writeonly uniform image2D paint;   // colour; sum of alphas, at most 1
// Plane of the facet. xyz: normal; w: dot(normal, position), from the camera.
layout(IMAGE(1), rgba32f) writeonly uniform image2D planes;
layout(IMAGE(2), r32ui) writeonly uniform uimage2D owners;
layout(STORAGE(4), std430) writeonly buffer Rest { uint rest_count; };

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel == ivec2(0)) rest_count = 0u;
  if (any(greaterThanEqual(texel, imageSize(paint)))) return;
  const vec2 at = min(vec2(texel) * float(kStep), view.size.xy - 1.0) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  const vec3 from_camera = fromCamera(at, depth);
  Sum sum = Sum(vec3(0.0), 1.0, 0.0, 0.0, 0u);
  vec4 plane = vec4(0.0);
  if (depth > 0.0) {
    plane.xyz = textureLod(facet_normal, uv, 0.0).xyz;
    plane.w = dot(plane.xyz, from_camera);
    // No early end below a sum of 1: each pixel that uses this sample has its own noise.
    sum = walk(from_camera, plane.xyz, 1.0);
  }
  imageStore(paint, texel, vec4(sum.color, min(sum.alphas, 1.0)));
  imageStore(planes, texel, plane);
  if ((kWanted & 4u) != 0u) imageStore(owners, texel, uvec4(sum.owner));
}
