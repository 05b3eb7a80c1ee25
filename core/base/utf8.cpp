// SPDX-License-Identifier: MIT
#include "core/base/utf8.h"

#include <cstdint>

namespace grisaille {
namespace {

// Bytes of the character that `text` begins with; 0 if it does not begin with a valid character.
// Overlong forms and surrogates are invalid (RFC 3629).
size_t lengthOf(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<uint8_t>(text[i]) : 0u; };
  const uint32_t first = byte(0);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  uint32_t code = first & (0x7fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if (byte(i) >> 6 != 2) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr uint32_t kLeast[] = {0x80, 0x800, 0x10000};  // by length
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool good = first >= 0xc0 && first < 0xf8 && code >= kLeast[length - 2] && code <= 0x10ffff;
  return good && !surrogate ? length : 0;
}

}  // namespace

size_t invalidUtf8(std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const size_t length = lengthOf(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return std::string_view::npos;
}

}  // namespace grisaille
