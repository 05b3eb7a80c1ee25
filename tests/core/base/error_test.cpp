// SPDX-License-Identifier: MIT
#include "core/base/error.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/utf8.h"

namespace grisaille {
namespace {

struct Listed {
  ErrorId id;
  int number;
  const char* name;
};

constexpr Listed kList[] = {
#define GRISAILLE_ERROR(name, number, remedy) {ErrorId::name, number, #name},
#include "core/base/error_list.h"
#undef GRISAILLE_ERROR
};

TEST(ErrorList, NumbersAreUniqueAndOfFourDigits) {
  std::set<int> numbers;
  for (const Listed& one : kList) {
    EXPECT_TRUE(numbers.insert(one.number).second) << one.name;
    EXPECT_GE(one.number, 1000) << one.name;
    EXPECT_LE(one.number, 9999) << one.name;
  }
}

TEST(ErrorList, EveryRemedyIsASentenceWithoutItsFullStop) {
  for (const Listed& one : kList) {
    const std::string_view remedy = remedyOf(one.id);
    ASSERT_FALSE(remedy.empty()) << one.name;
    EXPECT_TRUE(remedy[0] >= 'a' && remedy[0] <= 'z') << remedy;
    EXPECT_NE(remedy.back(), '.') << remedy;
    EXPECT_EQ(remedy.find('\n'), std::string_view::npos) << remedy;
  }
}

TEST(Error, IsOneLineWithNumberDetailAndRemedy) {
  const Error error(ErrorId::kUsage, "'{}' is no {}", "x", "number");
  EXPECT_STREQ(error.what(), "error E5101: 'x' is no number; see --help");
  EXPECT_EQ(error.detail(), "'x' is no number");
  EXPECT_EQ(error.id(), ErrorId::kUsage);
}

TEST(OneLine, HasNoControlCharacterAndAnEnd) {
  EXPECT_EQ(oneLine("plain \xc3\xa9"), "plain \xc3\xa9");
  EXPECT_EQ(oneLine("a\nb\tc\x1b[2J\x7f"), "a?b?c?[2J?");
  for (char c = 1; c < ' '; ++c) EXPECT_EQ(oneLine(std::string(1, c)), "?") << int{c};
  EXPECT_LE(oneLine(std::string(100000, 'x')).size(), 410u);
  EXPECT_GE(oneLine(std::string(100000, 'x')).size(), 400u);
}

TEST(OneLine, IsUtf8WhateverAFileHolds) {
  EXPECT_EQ(oneLine("\"POSITI\xe3N\""), "\"POSITI?N\"");
  EXPECT_EQ(oneLine("\xff\xc3\xa9\x80"), "?\xc3\xa9?");
  for (size_t ahead = 390; ahead < 401; ++ahead) {  // the cut meets each byte of a character
    const std::string line = oneLine(std::string(ahead, 'x') + "\xf0\x9f\x8e\xa8 and more text");
    EXPECT_EQ(invalidUtf8(line), std::string_view::npos) << ahead;
  }
}

}  // namespace
}  // namespace grisaille
