// SPDX-License-Identifier: MIT
#include "core/base/colour.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/color_space.hpp>

namespace grisaille {

std::optional<LinearColour> colourOf(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  uint32_t bits = 0;
  const auto [end, status] = std::from_chars(text.data() + 1, text.data() + 7, bits, 16);
  if (status != std::errc() || end != text.data() + 7) return std::nullopt;
  const glm::dvec3 encoded = glm::dvec3(bits >> 16, bits >> 8 & 255u, bits & 255u) / 255.0;
  const glm::vec3 linear(glm::convertSRGBToLinear(encoded));
  return LinearColour{linear.x, linear.y, linear.z};
}

std::string colourText(const LinearColour& colour) {
  const glm::vec3 linear(colour[0], colour[1], colour[2]);
  const glm::uvec3 bytes(glm::round(glm::convertLinearToSRGB(linear) * 255.0f));
  return fmt::format("#{:02x}{:02x}{:02x}", bytes.x, bytes.y, bytes.z);
}

}  // namespace grisaille
