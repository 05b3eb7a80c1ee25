#version 460
// SPDX-License-Identifier: MIT
// The mode surface below full resolution, second pass: paint out of the samples about a pixel that lie
// on its plane, and the splat step. What no sample serves goes on a list: rest.comp walks it. A thread
// makes the pixels between four samples, which it reads once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "splat.glsl"
#include "outputs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const uint kStep = 2;    // pixels
layout(constant_id = 3) const uint kRefine = 2;  // as the parameter: nothing, edges, rims
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
layout(TEXTURE(2)) uniform sampler2D samples;  // as samples.comp leaves them
layout(TEXTURE(3)) uniform sampler2D planes;
layout(TEXTURE(4)) uniform usampler2D owners;
layout(STORAGE(4), std430) buffer Rest {
  uint rest_count;
  uint rest[];  // x | y << 16
};

const float kSameFacing = 0.9;  // least cosine between the facets of a pixel and a sample
const float kOffPlane = 0.5;    // a pixel's distance from the sample's plane, in pixels
// Of coverage or a colour between samples: what changes more may be a rim.
const float kRim = 0.25;

// The samples at a cell's corners: by rows.
struct Corners {
  vec4 paint[4];
  vec4 plane[4];
  uint owner[4];
};

void makePixel(Corners corners, ivec2 pixel, vec2 share) {
  const vec2 at = vec2(pixel) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  const vec3 normal = textureLod(facet_normal, uv, 0.0).xyz;
  const vec3 from_camera = fromCamera(at, depth);
  const float off = kOffPlane * splat.pixel_slope * depth;
  vec3 color = vec3(0.0);
  float alphas = 0.0, all = 0.0, painted = 0.0, nearest = 0.0;
  vec4 least = vec4(1e30), most = vec4(-1e30);  // colour of those with paint; coverage of all
  uint owner = 0u, near = 0u;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec2 of = vec2((i & 1) != 0 ? share.x : 1.0 - share.x, (i & 2) != 0 ? share.y : 1.0 - share.y);
    const vec4 plane = corners.plane[i], paint = corners.paint[i];
    const bool fits = dot(plane.xyz, normal) >= kSameFacing && abs(dot(plane.xyz, from_camera) - plane.w) <= off;
    const float weight = fits ? of.x * of.y : 0.0;
    const float drawn = paint.a > 0.0 ? weight : 0.0;
    all += weight;
    painted += drawn;
    alphas += weight * paint.a;
    color += drawn * paint.rgb;
    least = min(least, vec4(drawn > 0.0 ? paint.rgb : vec3(1e30), weight > 0.0 ? paint.a : 1e30));
    most = max(most, vec4(drawn > 0.0 ? paint.rgb : vec3(-1e30), weight > 0.0 ? paint.a : -1e30));
    if ((kWanted & 4u) != 0u && drawn > nearest) {
      nearest = drawn;
      owner = corners.owner[i];
    }
  }
  if (kRefine == 0u && all <= 0.0) {
    const int i = (share.x >= 0.5 ? 1 : 0) + (share.y >= 0.5 ? 2 : 0);
    const vec4 paint = i == 0 ? corners.paint[0] : i == 1 ? corners.paint[1] : i == 2 ? corners.paint[2] : corners.paint[3];
    all = painted = 1.0;
    color = paint.rgb;
    alphas = depth > 0.0 ? paint.a : 0.0;
    owner = i == 0 ? corners.owner[0] : i == 1 ? corners.owner[1] : i == 2 ? corners.owner[2] : corners.owner[3];
  }
  const bool rim = any(greaterThan(most - least, vec4(kRim)));
  if (depth > 0.0 && (kRefine >= 1u && all <= 0.0 || kRefine >= 2u && rim)) {
    rest[atomicAdd(rest_count, 1u)] = uint(pixel.x) | uint(pixel.y) << 16;
  } else {
    const float coverage = alphas / max(all, 1e-20);
    const bool open = coverage > 0.0 && coverage < 0.9 + splat.half_width && (kWanted & 1u) != 0u;
    const float noise = splatNoise(from_camera, depth, open ? splat.octaves : 0u);
    writePaint(pixel, color / max(painted, 1e-20), coverage, owner, noise);
  }
}

void main() {
  const vec2 cell = vec2(gl_GlobalInvocationID.xy);
  const ivec2 first = ivec2(gl_GlobalInvocationID.xy * kStep);
  const ivec2 size = ivec2(view.size.xy);
  if (any(greaterThanEqual(first, size))) return;
  const vec2 texel = 1.0 / vec2(textureSize(samples, 0));
  Corners corners;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec2 place = (cell + vec2(i & 1, i >> 1) + 0.5) * texel;
    corners.paint[i] = textureLod(samples, place, 0.0);
    corners.plane[i] = textureLod(planes, place, 0.0);
    corners.owner[i] = (kWanted & 4u) != 0u ? textureLod(owners, place, 0.0).x : 0u;
  }
  // The last samples of a row or a column may stand closer.
  const vec2 across = max(min(vec2(kStep), vec2(size - 1 - first)), 1.0);
  for (uint i = 0u; i < kStep * kStep; ++i) {
    const ivec2 inside = ivec2(i % kStep, i / kStep);
    const ivec2 pixel = first + inside;
    if (all(lessThan(pixel, size))) makePixel(corners, pixel, vec2(inside) / across);
  }
}
