#version 460
// SPDX-License-Identifier: MIT
// The mode surface below full resolution, first pass: the pixels that stand kStep apart, and the last
// of each row and column, walk. upsample.comp makes the others out of them.
#extension GL_GOOGLE_include_directive : require
#include "place.glsl"

layout(constant_id = 0) const uint kWanted = 7;  // as in outputs.glsl
#include "walk.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const uint kStep = 2;  // pixels
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
layout(IMAGE(0), rgba16f) writeonly uniform image2D paint;   // colour; sum of alphas, at most 1
layout(IMAGE(1), rgba32f) writeonly uniform image2D planes;  // facet's normal; its product with the place
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
    // What other pixels' noise lets through is not known here.
    sum = walk(from_camera, plane.xyz, 1.0);
  }
  imageStore(paint, texel, vec4(sum.color, min(sum.alphas, 1.0)));
  imageStore(planes, texel, plane);
  if ((kWanted & 4u) != 0u) imageStore(owners, texel, uvec4(sum.owner));
}
