// SPDX-License-Identifier: MIT
// What a pass of PaintWorld::thin() has found so far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grisaille::sspm {

struct Thinning {
  size_t cell = 0;                 // the next one to look at
  std::vector<bool> checked;       // for each shot: placed when the pass began
  std::vector<bool> shows;         // it adds something at a spot
  std::vector<uint32_t> hiddenBy;  // 1 + the newest shot that hides it at a spot; 0: none does

  bool isActive() const { return !checked.empty(); }
  uint64_t bytes() const {
    return (checked.capacity() + shows.capacity()) / 8 + hiddenBy.capacity() * sizeof(uint32_t);
  }
};

}  // namespace grisaille::sspm
