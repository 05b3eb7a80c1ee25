// SPDX-License-Identifier: MIT
// Which pixels of a picture are traced first, so that a few of them stand for all: one of each 4 x
// 4 square, then one of each 2 x 2, then the rest. Which one of a square is a matter of chance, so
// that no pattern that repeats from square to square, as a kernel's rotations do, is met at one and
// the same place of it. Within each of the three, every run of pixels is spread over the picture.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace grisaille::app::truth {

// Indices by rows, each once. The same for one size.
std::vector<uint32_t> pixelOrder(glm::uvec2 size);

// The index of the pixel that stands for this one: itself where it is traced, else the one of its
// 2 x 2 square, else the one of its 4 x 4 square, else none (UINT32_MAX). isTraced(index) tells.
template <typename IsTraced>
uint32_t standIn(glm::uvec2 pixel, glm::uvec2 size, const IsTraced& isTraced);

// The pixel that comes first of the 2 x 2 or 4 x 4 square that this one is in.
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
