#version 460
// SPDX-License-Identifier: MIT
// Marches a ray towards the light, for one pixel of each 2x2 block. One thread for each block.
#extension GL_GOOGLE_include_directive : require
#include "settings.glsl"

layout(TEXTURE(0)) uniform sampler2D view_depth;    // metres; 0: sky
layout(TEXTURE(1)) uniform sampler2D facet_normal;  // world, unit, towards the camera
layout(IMAGE(0), rg32f) writeonly uniform image2D traced;  // visibility, view depth

// The integer hash of Jarzynski and Olano, "Hash Functions for GPU Rendering" (JCGT 2020): pcg.
float noise(uvec2 pixel, uint frame) {
  uint state = (pixel.x + 8192u * pixel.y + 67108864u * frame) * 747796405u + 2891336453u;
  state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float((state >> 22u) ^ state) * (1.0 / 4294967296.0);
}

// How much light reaches a position in view space: 1 or, near the end of the ray, in between.
float lightAt(vec3 position, float jitter) {
  const int steps = int(settings.steps);
  for (int i = 0; i < steps; ++i) {
    const float share = (float(i) + jitter) / settings.steps;
    const vec3 at = position + settings.light.xyz * (settings.reach * share);
    if (at.z > -view.planes.x) break;
    const vec2 pixel = pixelOf(at);
    if (any(lessThan(pixel, vec2(0.0))) || any(greaterThan(pixel, view.size.xy))) break;
    const float depth = textureLod(view_depth, pixel * view.size.zw, 0.0).x;
    const float behind = -at.z - depth;
    if (depth > 0.0 && behind > pixelSize(depth) && behind < settings.thickness) {
      return smoothstep(0.6, 1.0, share);
    }
  }
  return 1.0;
}

void main() {
  const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(block, imageSize(traced)))) return;
  // Each frame takes another pixel of the block.
  const uint turn = settings.index & 3u;
  const ivec2 wanted = 2 * block + ivec2((turn ^ (turn >> 1)) & 1u, turn >> 1);
  const vec2 at = vec2(min(wanted, ivec2(view.size.xy) - 1)) + 0.5;
  const float depth = textureLod(view_depth, at * view.size.zw, 0.0).x;
  float light = 1.0;
  if (depth > 0.0) {
    const vec3 world = textureLod(facet_normal, at * view.size.zw, 0.0).xyz;
    const vec3 normal = mat3(view.view_from_world) * world;
    // Two pixels in front of the surface, so that the ray does not start inside of it.
    const vec3 start = viewPosition(at, depth) + normal * (2.0 * pixelSize(depth));
    // The renderer's light does not reach surfaces that face away: they need no shadow.
    const float facing = smoothstep(0.0, 0.2, dot(normal, settings.light.xyz));
    if (facing > 0.0) {
      light = mix(1.0, lightAt(start, noise(uvec2(block), settings.index)), facing);
    }
  }
  imageStore(traced, block, vec4(light, depth, 0.0, 0.0));
}
