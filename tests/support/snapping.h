// SPDX-License-Identifier: MIT
// How exactly a device's rasteriser places vertices, measured by drawing.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::tests {

struct Snapping {
  // A vertex moves to a multiple of 1 / 2^bits pixels before its triangle is drawn, so by at most
  // half of that each way: an edge may cover another pixel centre.
  int bits = 0;
  // How far from a pixel's centre, in pixels each way, lies the place whose depth the pixel gets.
  // About 0 where depths are interpolated between the vertices as they were given; up to half a
  // step of `bits` where they are interpolated between the snapped ones.
  double depthShift = 0;

  // Half a step, pixels.
  double halfStep() const { return 0.5 / (1 << bits); }
  // Whether tests with exact places allow for a shift. GPUs have 8 bits.
  bool isCoarse() const { return bits < 8 || depthShift > 1.0 / 256; }
};

Snapping measureSnapping(gpu::Device& device);

}  // namespace grisaille::tests
