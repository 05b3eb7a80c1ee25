// SPDX-License-Identifier: MIT
#include "app/truth/pixel_order.h"

#include <array>

#include "core/trace/sampling.h"

namespace grisaille::app::truth {
namespace {

// A random pixel of the square around `pixel`. Squares have `side` pixels a side and are clipped to
// the picture.
glm::uvec2 anyOfSquare(glm::uvec2 pixel, uint32_t side, glm::uvec2 size) {
  const glm::uvec2 corner = pixel / side * side;
  const glm::uvec2 extent = glm::min(glm::uvec2(side), size - corner);
  const uint32_t bits = trace::hashBits(corner.x + trace::hashBits(corner.y + side));
  return corner + glm::uvec2((bits & 0xffffu) % extent.x, (bits >> 16) % extent.y);
}

// Number of runs in each of the three levels. Each run is spread over the whole picture.
constexpr size_t kRuns = 64;

}  // namespace

glm::uvec2 firstOfTwo(glm::uvec2 pixel, glm::uvec2 size) {
  return anyOfSquare(pixel, 2, size);
}

glm::uvec2 firstOfFour(glm::uvec2 pixel, glm::uvec2 size) {
  return firstOfTwo(anyOfSquare(pixel, 4, size), size);
}

std::vector<uint32_t> pixelOrder(glm::uvec2 size) {
  std::array<std::vector<uint32_t>, 3> levels;
  for (uint32_t y = 0; y < size.y; ++y) {
    for (uint32_t x = 0; x < size.x; ++x) {
      const glm::uvec2 pixel(x, y);
      const size_t level = firstOfFour(pixel, size) == pixel  ? 0
                           : firstOfTwo(pixel, size) == pixel ? 1
                                                              : 2;
      levels[level].push_back(y * size.x + x);
    }
  }
  std::vector<uint32_t> order;
  order.reserve(size_t{size.x} * size.y);
  for (const std::vector<uint32_t>& level : levels) {
    for (size_t run = 0; run < kRuns; ++run) {
      for (size_t i = run; i < level.size(); i += kRuns) order.push_back(level[i]);
    }
  }
  return order;
}

}  // namespace grisaille::app::truth
