// SPDX-License-Identifier: MIT
#include "core/base/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace grisaille {
namespace {

constexpr size_t kAll = std::string_view::npos;

std::string encoded(uint32_t code, int length) {
  if (length == 1) return {static_cast<char>(code)};
  std::string text;
  for (int i = length - 1; i > 0; --i) text += static_cast<char>(0x80 | (code >> (6 * i) & 0x3f));
  text += static_cast<char>(0x80 | (code & 0x3f));
  const uint32_t lead = 0xf00u >> length & 0xffu;
  text[0] = static_cast<char>(lead | code >> (6 * (length - 1)));
  return text;
}

int lengthOf(uint32_t code) {
  return code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
}

TEST(Utf8, EveryCharacterPassesAndSurrogatesDoNot) {
  for (uint32_t code = 0; code <= 0x10ffff; ++code) {
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    const std::string text = encoded(code, lengthOf(code));
    if (invalidUtf8(text) != (surrogate ? 0 : kAll)) ADD_FAILURE() << std::hex << code;
  }
  EXPECT_EQ(invalidUtf8(encoded(0x110000, 4)), 0u);
  EXPECT_EQ(invalidUtf8(""), kAll);
}

TEST(Utf8, FormsThatAreTooLongAreRefused) {
  for (uint32_t code = 0; code < 0x10000; ++code) {
    for (int length = lengthOf(code) + 1; length <= 4; ++length) {
      if (invalidUtf8(encoded(code, length)) != 0) ADD_FAILURE() << std::hex << code;
    }
  }
}

TEST(Utf8, TheFirstWrongByteIsFound) {
  const std::string good = "a\xc3\xa9\xe2\x82\xac\xf0\x9f\x8e\xa8";
  ASSERT_EQ(invalidUtf8(good), kAll);
  for (const char* wrong :
       {"\x80", "\xbf", "\xc0", "\xff", "\xfe", "\xc3", "\xe2\x82", "\xf0\x9f"}) {
    EXPECT_EQ(invalidUtf8(good + wrong), good.size());
    EXPECT_EQ(invalidUtf8(good + wrong + "a"), good.size());
    EXPECT_EQ(invalidUtf8(wrong + good), 0u);
  }
  for (size_t cut = 0; cut <= good.size(); ++cut) {
    const bool whole = cut == 0 || cut == 1 || cut == 3 || cut == 6 || cut == good.size();
    const size_t start = cut < 3 ? 1 : cut < 6 ? 3 : 6;
    EXPECT_EQ(invalidUtf8(good.substr(0, cut)), whole ? kAll : start) << cut;
  }
}

}  // namespace
}  // namespace grisaille
