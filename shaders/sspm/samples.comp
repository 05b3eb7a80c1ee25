#version 460
// SPDX-License-Identifier: MIT
// Mode `surface` below full resolution, first pass: walks the lists of every kStep-th pixel of a
// row and a column, and of the last pixel of each. upsample.comp computes the other pixels from
// these samples.
#extension GL_GOOGLE_include_directive : require
#include "splat.glsl"
#include "walk.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kCovered = false;  // the output `paint_coverage` is wanted
layout(constant_id = 2) const uint kStep = 2;         // pixels
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
// x: the owner, 1 + a record; y: what walk() calls blocked; z: Sum.before; w: strengths, at most 1,
// plus 2 if alpha is 1.
layout(IMAGE(0), rgba32f) writeonly uniform image2D samples;
// Plane of the facet. xyz: normal; w: dot(normal, position), from the camera.
layout(IMAGE(1), rgba32f) writeonly uniform image2D planes;
layout(STORAGE(4), std430) writeonly buffer Rest { uint rest_count; };

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (texel == ivec2(0)) rest_count = 0u;
  if (any(greaterThanEqual(texel, imageSize(samples)))) return;
  const vec2 at = min(vec2(texel) * float(kStep), view.size.xy - 1.0) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  Sum sum = kNothing;
  vec4 plane = vec4(0.0);
  uint blocked = 0u;
  if (depth > 0.0) {
    const Point point = Point(fromCamera(at, depth), textureLod(facet_normal, uv, 0.0).xyz, pixelSize(depth));
    plane = vec4(point.normal, dot(point.normal, point.from_camera));
    sum = walk(point, kCovered, blocked);
  }
  imageStore(samples, texel, vec4(float(sum.owner), float(blocked), sum.before, min(sum.strengths, 1.0) + (sum.alpha >= 1.0 ? 2.0 : 0.0)));
  imageStore(planes, texel, plane);
}
