#version 460
// SPDX-License-Identifier: MIT
// The blur disc of each pixel, and the largest disc of each tile. One thread for each pixel.
#extension GL_GOOGLE_include_directive : require
#include "lens.glsl"

layout(TEXTURE(0)) uniform sampler2D view_depth;     // metres; 0: sky
layout(IMAGE(0), r16f) writeonly uniform image2D radius;  // pixels; below 0: nearer than the focus
layout(IMAGE(1), r16f) writeonly uniform image2D tiles;   // largest |radius|, pixels
shared uint most;  // bits of a float that is not below 0, in the floats' order

void main() {
  if (gl_LocalInvocationIndex == 0) most = 0;
  barrier();
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  const float depth = textureLod(view_depth, (vec2(pixel) + 0.5) * view.size.zw, 0.0).x;
  // Circle of confusion of a thin lens (Potmesil and Chakravarty 1981). All rays from the lens meet
  // at `focus`; at another depth they fill a disc of aperture * |depth - focus| / focus.
  float metres = 0.5 * lens.aperture / lens.focus;
  if (depth > 0.0) {
    metres *= (depth - lens.focus) * pixelsPerMetre(depth);
  } else {
    metres *= orthographic() ? 1e9 : pixelsPerMetre(1.0);  // the limit at infinity
  }
  const float disc = clamp(metres, -lens.largest, lens.largest);
  if (all(lessThan(pixel, ivec2(view.size.xy)))) {
    imageStore(radius, pixel, vec4(disc));
    atomicMax(most, floatBitsToUint(abs(disc)));
  }
  barrier();
  if (gl_LocalInvocationIndex == 0) {
    imageStore(tiles, ivec2(gl_WorkGroupID.xy), vec4(uintBitsToFloat(most)));
  }
}
