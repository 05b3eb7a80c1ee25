#version 460
// SPDX-License-Identifier: MIT
// Blends the decals whose boxes contain the pixel's surface, front to back. One thread per pixel.
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"

struct Box {
  mat3x4 axes;  // (p, 1) * axes: -0.5 ... 0.5 in the box; p: from the camera, world axes, metres
  float opacity, layer;
  float cosine;    // of the largest angle between the decal's direction and a normal
  float per_fade;  // 1 / fade
};
const uint kSide = 8, kMost = 4064;
layout(constant_id = 0) const bool kAny = true;  // whether there are decals
layout(local_size_x = kSide, local_size_y = kSide) in;
layout(STORAGE(0), std430) readonly buffer Boxes { Box boxes[]; };  // the topmost first
layout(TEXTURE(0)) uniform sampler2D view_depth;     // metres; 0: sky
layout(TEXTURE(1)) uniform sampler2D facet_normal;   // unit, towards the camera
layout(TEXTURE(2)) uniform sampler2DArray pictures;  // linear, premultiplied alpha
layout(IMAGE(0), rgba16f) writeonly uniform image2D overlay;
shared uint nearest, farthest;  // bits of the group's view depths, in the depths' order
shared uint candidates[kMost / 32 + 1];  // a bit for each box

// Offset from p to the point at which another pixel's ray meets the plane of p.
vec3 footprint(vec2 pixel, vec3 p, vec3 normal) {
  const vec3 from = p - rayStart(pixel) * mat3(view.view_from_world);
  const vec3 ray = rayDirection(pixel) * mat3(view.view_from_world);
  return ray * (dot(normal, from) / min(dot(normal, ray), -1e-3)) - from;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const uint thread = gl_LocalInvocationIndex, count = min(boxes.length(), kMost);
  const vec2 at = vec2(pixel) + 0.5;
  const float depth = textureLod(view_depth, at * view.size.zw, 0.0).x;
  const vec3 normal = textureLod(facet_normal, at * view.size.zw, 0.0).xyz;
  const vec3 p = viewPosition(at, depth) * mat3(view.view_from_world);
  const vec3 dx = footprint(at + vec2(1.0, 0.0), p, normal);
  const vec3 dy = footprint(at + vec2(0.0, 1.0), p, normal);
  candidates[thread] = candidates[thread + 64] = 0;
  if (thread == 0) nearest = floatBitsToUint(1e30), farthest = 0;
  barrier();
  if (depth > 0.0) atomicMin(nearest, floatBitsToUint(depth));
  atomicMax(farthest, floatBitsToUint(depth));
  barrier();
  // Bounding sphere of the group's surfaces.
  const vec2 corner = vec2(gl_WorkGroupID.xy * kSide), middle = corner + 0.5 * kSide;
  const float back = uintBitsToFloat(farthest), front = min(uintBitsToFloat(nearest), back);
  const vec3 end = viewPosition(middle, back), centre = viewPosition(middle, 0.5 * (front + back));
  const float radius = distance(centre, end) + distance(end, viewPosition(corner, back));
  const vec4 sphere = vec4(centre * mat3(view.view_from_world), 1.0);

  for (uint i = thread; kAny && i < count; i += kSide * kSide) {
    const mat3x4 axes = boxes[i].axes;
    const vec3 reach = vec3(length(axes[0].xyz), length(axes[1].xyz), length(axes[2].xyz));
    const bool met = all(lessThan(abs(sphere * axes), 0.5 + reach * radius));
    if (met) atomicOr(candidates[i / 32], 1u << (i % 32));
  }
  barrier();
  vec4 sum = vec4(0.0);  // premultiplied
  uint word = 0, bits = candidates[0];
  while (kAny && depth > 0.0 && sum.a < 0.999) {
    // An inner loop finds the next visible box: threads wait for the longest loop body.
    Box box;
    vec3 local;
    vec2 du, dv, share = vec2(0.0);  // share of the pixel's footprint in the box, per axis
    while (word * 32 < count && share.x * share.y <= 0.0) {
      if (bits == 0) {
        bits = candidates[++word];
        continue;
      }
      box = boxes[word * 32 + findLSB(bits)];
      bits &= bits - 1;
      local = vec4(p, 1.0) * box.axes;
      du = vec2(vec4(dx, 0.0) * box.axes), dv = vec2(vec4(dy, 0.0) * box.axes);
      const vec2 wide = max(abs(du) + abs(dv), 1e-6);
      const vec2 inside = min(local.xy + 0.5 * wide, 0.5) - max(local.xy - 0.5 * wide, -0.5);
      const float facing = dot(normal, normalize(box.axes[2].xyz));
      if (abs(local.z) < 0.5 && facing >= box.cosine) share = clamp(inside / wide, 0.0, 1.0);
    }
    if (share.x * share.y <= 0.0) break;
    const float fade = min((1.0 - 2.0 * abs(local.z)) * box.per_fade, 1.0);
    const vec3 texel = vec3(0.5 + local.x, 0.5 - local.y, box.layer);
    const vec4 over = textureGrad(pictures, texel, du, dv);
    sum += over * (share.x * share.y * fade * box.opacity * (1.0 - sum.a));
  }
  if (any(greaterThanEqual(pixel, imageSize(overlay)))) return;
  imageStore(overlay, pixel, vec4(sum.rgb / max(sum.a, 1e-6), sum.a));
}
