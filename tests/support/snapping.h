// SPDX-License-Identifier: MIT
// Measures, by drawing, how exactly a device's rasteriser places vertices.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::tests {

struct Snapping {
  // The rasteriser snaps vertices to multiples of 1 / 2^bits pixels, which moves each by at most
  // half a step per axis. An edge may then cover another pixel centre.
  int bits = 0;
  // Largest distance per axis, in pixels, between a pixel's centre and the point where its depth is
  // evaluated. About 0 if the rasteriser interpolates depth between the original vertices; up to
  // half a step of `bits` if it interpolates between the snapped ones.
  double depthShift = 0;

  // Half a snapping step, pixels.
  double halfStep() const { return 0.5 / (1 << bits); }
  // Whether edges move so far that tests of places must allow for it. GPUs have 8 bits.
  bool isCoarse() const { return bits < 8; }
  // Whether depth is interpolated between the snapped vertices, as NVIDIA's GPUs do too.
  bool movesDepth() const { return depthShift > 1.0 / 4096; }
};

Snapping measureSnapping(gpu::Device& device);

}  // namespace grisaille::tests
