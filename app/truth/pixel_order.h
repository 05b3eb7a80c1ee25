// SPDX-License-Identifier: MIT
// The order in which the pixels of a picture are traced, so that the first ones represent all: one
// pixel of each 4 x 4 square, then one of each 2 x 2 square, then all others. The pixel of a square
// is random: a pattern that repeats from square to square, for example a kernel's rotations, is not
// always sampled at the same place. In each of the three levels, every run of pixels is spread over
// the picture.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace grisaille::app::truth {

// Every pixel index (by rows) once, in tracing order. Depends on the size only.
std::vector<uint32_t> pixelOrder(glm::uvec2 size);

// The index of the traced pixel that stands for `pixel`: the pixel itself, else the first one of
// its 2 x 2 square, else the first one of its 4 x 4 square. UINT32_MAX: none of them is traced.
// `isTraced`: called with an index.
template <typename IsTraced>
uint32_t standIn(glm::uvec2 pixel, glm::uvec2 size, const IsTraced& isTraced);

// The pixel that is traced first in the 2 x 2 or 4 x 4 square around `pixel`.
glm::uvec2 firstOfTwo(glm::uvec2 pixel, glm::uvec2 size);
glm::uvec2 firstOfFour(glm::uvec2 pixel, glm::uvec2 size);

template <typename IsTraced>
uint32_t standIn(glm::uvec2 pixel, glm::uvec2 size, const IsTraced& isTraced) {
  const auto index = [&](glm::uvec2 at) { return at.y * size.x + at.x; };
  if (isTraced(index(pixel))) return index(pixel);
  const uint32_t two = index(firstOfTwo(pixel, size));
  if (isTraced(two)) return two;
  const uint32_t four = index(firstOfFour(pixel, size));
  return isTraced(four) ? four : UINT32_MAX;
}

}  // namespace grisaille::app::truth
