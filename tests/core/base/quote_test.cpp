// SPDX-License-Identifier: MIT
#include "core/base/quote.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace grisaille {
namespace {

TEST(ShellQuoted, PlainWordsStayAsTheyAre) {
  for (const char* word :
       {"a", "ssao.radius=0.5", "/usr/lib/x.so", "a_b-c%d+e@f:g,h", "1920x1080"}) {
    EXPECT_EQ(shellQuoted(word), word);
  }
  EXPECT_EQ(shellQuoted(""), "''");
  EXPECT_EQ(shellQuoted("a b"), "'a b'");
  EXPECT_EQ(shellQuoted("it's"), "'it'\\''s'");
  EXPECT_EQ(shellQuoted("#ff8000"), "'#ff8000'");
}

// The word as a shell reads it.
std::string printed(const std::string& word) {
  FILE* shell = popen(("printf %s " + shellQuoted(word)).c_str(), "r");
  if (shell == nullptr) return "no shell";
  std::string text;
  for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) text += static_cast<char>(c);
  pclose(shell);
  return text;
}

TEST(ShellQuoted, AShellReadsEveryWordBack) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    std::string word;
    for (size_t n = random() % 20; n > 0; --n) word += static_cast<char>(1 + random() % 127);
    EXPECT_EQ(printed(word), word) << i;
  }
}

}  // namespace
}  // namespace grisaille
