// SPDX-License-Identifier: MIT
// How far the two sides of the picture are apart, as numbers: computed on the device, since reading
// both pictures back would take many milliseconds a frame.
#pragma once

#include <array>
#include <cstdint>

#include "app/viewer/stage.h"
#include "core/gpu/device.h"

namespace grisaille::app::viewer {

// Over all pixels and channels of both sides, in the outputs' own unit. Values that are not finite
// do not count.
struct SideNumbers {
  uint64_t compared = 0;  // values; 0: nothing was compared
  double rmse = 0;
  double largest = 0;  // absolute difference
};

class SideDifference {
 public:
  // The device must outlive this.
  explicit SideDifference(gpu::Device& device) : device_(device) {}
  ~SideDifference();
  SideDifference(const SideDifference&) = delete;
  SideDifference& operator=(const SideDifference&) = delete;

  // Compares two sides of one size and kind. `size`: texels. Waits for the device. Call it between
  // two frames.
  SideNumbers compare(const std::array<Side, 2>& sides, glm::uvec2 size);

 private:
  gpu::Device& device_;
  gpu::ComputePipeline pipeline_;
  gpu::Sampler nearest_;
  gpu::Buffer sums_;
  uint64_t groups_ = 0;  // that sums_ has room for
};

}  // namespace grisaille::app::viewer
