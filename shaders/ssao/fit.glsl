// SPDX-License-Identifier: MIT
// At a crease all texels of a surface lie on one side of it, and their mean is that of a place beside
// the texel. A line that is fitted through them tells how much their visibility changes up to the texel
// (local linear regression: Fan 1992, "Design-adaptive Nonparametric Regression").

// Share of the line's change that is taken. All of it makes leaves noisy.
const float kFitted = 0.5;
// Least variance of the offsets that a slope is divided by, texels^2.
const float kLeastSpread = 0.5;

// What the line adds to the mean visibility `open`, for four lines. Weighted means of the texels: of
// their `offset` from the centre, of its square, and of its product with their visibility.
vec4 changeToCentre(vec4 open, vec4 offset, vec4 square, vec4 product) {
  const vec4 slope = (product - offset * open) / max(square - offset * offset, kLeastSpread);
  return -kFitted * offset * slope;
}
