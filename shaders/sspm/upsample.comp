#version 460
// SPDX-License-Identifier: MIT
// Mode `surface` below full resolution, second pass: joint bilateral upsampling (Kopf et al. 2007).
// A pixel blends the four samples around it bilinearly, and leaves out samples whose plane it does
// not lie on. Then follows the splat step. Pixels that the parameter `refine` selects go on a list
// for rest.comp instead. One thread computes the pixels between four samples, which it reads once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "splat.glsl"
#include "outputs.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const uint kStep = 2;    // pixels
layout(constant_id = 3) const uint kRefine = 2;  // the parameter `refine`: nothing, edges, rims
layout(TEXTURE(0)) uniform sampler2D view_depth;
layout(TEXTURE(1)) uniform sampler2D facet_normal;
layout(TEXTURE(2)) uniform sampler2D samples;  // outputs of samples.comp
layout(TEXTURE(3)) uniform sampler2D planes;
layout(TEXTURE(4)) uniform usampler2D owners;
layout(STORAGE(4), std430) buffer Rest {
  uint rest_count;
  uint rest[];  // x | y << 16
};

const float kSameFacing = 0.9;  // least cosine between the facets' normals of pixel and sample
const float kOffPlane = 0.5;    // plane tolerance, in pixels' widths
// Difference of coverage or of a colour channel between samples above which a pixel counts as a
// rim.
const float kRim = 0.25;

// The four samples around a pixel, by rows.
struct Corners {
  vec4 paint[4];
  vec4 plane[4];
  uint owner[4];
};

// Upsamples one pixel, or appends it to the list. share: its position between the samples, 0 to 1.
void upsamplePixel(Corners corners, ivec2 pixel, vec2 share) {
  const vec2 at = vec2(pixel) + 0.5;
  const vec2 uv = at * view.size.zw;
  const float depth = textureLod(view_depth, uv, 0.0).x;
  const vec3 normal = textureLod(facet_normal, uv, 0.0).xyz;
  const vec3 from_camera = fromCamera(at, depth);
  const float tolerance = kOffPlane * pixelSize(depth);
  vec3 color = vec3(0.0);
  // Sums of weights: of all samples on the plane, and of those with paint, which alone blend
  // colours.
  float alphas = 0.0, all = 0.0, painted = 0.0, largest = 0.0;
  vec4 least = vec4(1e30), most = vec4(-1e30);  // rgb: of samples with paint; a: coverage of all
  uint owner = 0u;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec2 bilinear = vec2((i & 1) != 0 ? share.x : 1.0 - share.x,
                               (i & 2) != 0 ? share.y : 1.0 - share.y);
    const vec4 plane = corners.plane[i], paint = corners.paint[i];
    const bool on_plane = dot(plane.xyz, normal) >= kSameFacing &&
                          abs(dot(plane.xyz, from_camera) - plane.w) <= tolerance;
    const float weight = on_plane ? bilinear.x * bilinear.y : 0.0;
    const float paint_weight = paint.a > 0.0 ? weight : 0.0;
    all += weight;
    painted += paint_weight;
    alphas += weight * paint.a;
    color += paint_weight * paint.rgb;
    least = min(least, vec4(paint_weight > 0.0 ? paint.rgb : vec3(1e30),
                            weight > 0.0 ? paint.a : 1e30));
    most = max(most, vec4(paint_weight > 0.0 ? paint.rgb : vec3(-1e30),
                          weight > 0.0 ? paint.a : -1e30));
    if ((kWanted & 4u) != 0u && paint_weight > largest) {
      largest = paint_weight;
      owner = corners.owner[i];
    }
  }
  // No sample on the plane, and no refinement: takes the nearest sample.
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
    // At other coverages the noise decides nothing, and the shader skips its octaves.
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
  // The last two samples of a row or a column may be closer together.
  const vec2 across = max(min(vec2(kStep), vec2(size - 1 - first)), 1.0);
  for (uint i = 0u; i < kStep * kStep; ++i) {
    const ivec2 inside = ivec2(i % kStep, i / kStep);
    const ivec2 pixel = first + inside;
    if (all(lessThan(pixel, size))) upsamplePixel(corners, pixel, vec2(inside) / across);
  }
}
