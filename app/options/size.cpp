// SPDX-License-Identifier: MIT
#include "app/options/size.h"

#include <charconv>

#include "core/base/error.h"

namespace grisaille::app {

glm::uvec2 parseSize(const std::string& text) {
  glm::uvec2 size(0);
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.x);
  const bool cross = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.y) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end || size.x < 1 || size.y < 1 ||
      size.x > kLargestSide || size.y > kLargestSide) {
    throw Error(ErrorId::kUsage, "size '{}' is not WIDTHxHEIGHT with sides from 1 to {}", text,
                kLargestSide);
  }
  return size;
}

}  // namespace grisaille::app
