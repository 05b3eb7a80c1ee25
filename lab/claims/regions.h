// SPDX-License-Identifier: MIT
// The regions of a picture that expectations name. Rays through the scene determine them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/trace/flicker.h"

namespace grisaille::lab::claims {

struct RegionInfo {
  const char* key;
  const char* meaning;  // for reports
};

// Every region that a claim can name.
std::span<const RegionInfo> regions();

// What regions depend on besides the frame. Lengths in metres.
struct RegionScale {
  double radius = 0.5;   // of the occlusion
  double distance = 10;  // where "near" ends and "far" begins, view depth
  // 1 for each instance that moved since the frame before, by index; empty: none moved.
  std::span<const uint8_t> moved = {};
};

// 1 for each pixel of the frame that lies in all of `names`, known regions joined by "+".
std::vector<uint8_t> regionOf(std::string_view names, const trace::FlickerFrame& frame,
                              const RegionScale& scale);

// 1 for all pixels at most `margin` rows and columns from a pixel of the mask.
std::vector<uint8_t> widened(const std::vector<uint8_t>& mask, uint32_t width, uint32_t height,
                             uint32_t margin);

}  // namespace grisaille::lab::claims
