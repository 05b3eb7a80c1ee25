// SPDX-License-Identifier: MIT
// Outputs of both modes. An output that nothing reads is bound to a texture of one texel and not
// written.
layout(constant_id = 0) const uint kWanted = 7;  // bits: paint, paint_coverage, paint_owner
layout(IMAGE(0), rgba16f) writeonly uniform image2D paint_out;
layout(IMAGE(1), r32f) writeonly uniform image2D coverage_out;
layout(IMAGE(2), r32ui) writeonly uniform uimage2D owner_out;

// Writes a pixel's outputs.
void writePaint(ivec2 pixel, Sum sum) {
  if ((kWanted & 1u) != 0u) {
    const vec4 paint = vec4(sum.color / max(sum.alpha, 1e-20), sum.alpha);
    imageStore(paint_out, pixel, sum.alpha > 0.0 ? paint : vec4(0.0));
  }
  if ((kWanted & 2u) != 0u) imageStore(coverage_out, pixel, vec4(min(sum.strengths, 1.0)));
  if ((kWanted & 4u) != 0u) imageStore(owner_out, pixel, uvec4(sum.owner));
}
