// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace grisaille::app {

constexpr uint32_t kLargestSide = 16384;  // longest side of a picture, pixels

// Width divided by height.
inline double aspectOf(glm::uvec2 size) {
  return double{1} * size.x / size.y;
}

// Parses "1280x720". Throws kUsage.
glm::uvec2 parseSize(const std::string& text);

}  // namespace grisaille::app
