// SPDX-License-Identifier: MIT
// Outputs of both modes. An output that nothing reads is bound to a texture of one texel and not
// written.
layout(constant_id = 0) const uint kWanted = 7;  // bits: paint, paint_coverage, paint_owner
layout(IMAGE(0), rgba16f) writeonly uniform image2D paint_out;
layout(IMAGE(1), r32f) writeonly uniform image2D coverage_out;
layout(IMAGE(2), r32ui) writeonly uniform uimage2D owner_out;

// Sum of alphas above which no written output changes any more.
float enoughAlpha(float noise) {
  return (kWanted & 2u) != 0u ? 1.0 : min(noise + max(splat.half_width, 1e-6), 1.0);
}

// Writes a pixel's outputs: thresholds the coverage against the noise (step 4 of the definition).
// color: blended colour; alphas: sum of the shots' alphas.
// owner: 1 + number of the shot with the largest weight; 0: no paint.
void writePaint(ivec2 pixel, vec3 color, float alphas, uint owner, float noise) {
  const float coverage = min(alphas, 1.0);
  if ((kWanted & 1u) != 0u) {
    const float alpha = splatAlpha(coverage, noise);
    imageStore(paint_out, pixel, alpha > 0.0 ? vec4(color, alpha) : vec4(0.0));
  }
  if ((kWanted & 2u) != 0u) imageStore(coverage_out, pixel, vec4(coverage));
  if ((kWanted & 4u) != 0u) imageStore(owner_out, pixel, uvec4(owner));
}
