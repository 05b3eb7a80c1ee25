// SPDX-License-Identifier: MIT
#include "app/study/data_url.h"

#include <cstdint>

namespace grisaille::app::study {

// Base64: RFC 4648, section 4.
std::string dataUrl(std::string_view type, std::span<const std::byte> file) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:" + std::string(type) + ";base64,";
  for (size_t i = 0; i < file.size(); i += 3) {
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < file.size() ? std::to_integer<uint32_t>(file[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > file.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63u];
    }
  }
  return text;
}

}  // namespace grisaille::app::study
