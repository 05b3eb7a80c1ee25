// SPDX-License-Identifier: MIT
#include "lab/claims/expectation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"

namespace grisaille::lab::claims {
namespace {

TEST(Expectation, ReadsAllForms) {
  const Expectation full = parseExpectation("a.noise@flat+open > 1.5 * b-2.rmse");
  EXPECT_EQ(full.left, (Term{"a", "noise", "flat+open"}));
  EXPECT_EQ(full.op, ">");
  EXPECT_EQ(full.factor, 1.5);
  EXPECT_EQ(full.right, (Term{"b-2", "rmse", "all"}));
  const Expectation plain = parseExpectation("  a.bias <=   b.bias@edges ");
  EXPECT_EQ(plain.factor, 1);
  EXPECT_EQ(plain.right, (Term{"b", "bias", "edges"}));
  const Expectation number = parseExpectation("a.bias >= -0.25");
  EXPECT_EQ(number.right, std::nullopt);
  EXPECT_EQ(number.factor, -0.25);
  EXPECT_EQ(full.left.quantity(), "noise@flat+open");
  EXPECT_EQ(number.left.quantity(), "bias");
}

TEST(Expectation, MistakesAreRefused) {
  for (const char* text :
       {"", "a.rmse", "a.rmse <", "a.rmse < b.rmse b.rmse", "a.rmse = b.rmse", "a.rmse < x",
        "a.rmse < b * b.rmse", "a.rmse < 2 * 3", "a.rmse < 2 + b.rmse", "rmse < b.rmse",
        ".rmse < 1", "a.rms < 1", "a.rmse@none < 1", "a.rmse@ < 1", "a.rmse@flat+ < 1",
        "a.rmse < nan", "a.rmse < 1e999", "a.rmse < 2 * b.rmse < 3"}) {
    SCOPED_TRACE(text);
    EXPECT_ERROR(ErrorId::kUsage, parseExpectation(text));
  }
}

TEST(Expectation, HoldsAsNumbersCompare) {
  const auto with = [](const char* text, double a, double b) {
    return holds(parseExpectation(text), [&](const Term& t) { return t.run == "a" ? a : b; });
  };
  EXPECT_TRUE(with("a.rmse > 1.5 * b.rmse", 3.1, 2));
  EXPECT_FALSE(with("a.rmse > 1.5 * b.rmse", 3, 2));
  EXPECT_TRUE(with("a.rmse >= 1.5 * b.rmse", 3, 2));
  EXPECT_TRUE(with("a.rmse < b.rmse", 1, 2));
  EXPECT_FALSE(with("a.rmse < b.rmse", 2, 2));
  EXPECT_TRUE(with("a.rmse <= b.rmse", 2, 2));
  EXPECT_TRUE(with("a.rmse < 0.5", 0.4, 0));
  EXPECT_FALSE(with("a.rmse < 0.5", 0.6, 0));
  for (const char* op : {"<", "<=", ">", ">="}) {
    const std::string text = std::string("a.rmse ") + op + " b.rmse";
    EXPECT_FALSE(with(text.c_str(), std::nan(""), 1)) << text;
    EXPECT_FALSE(with(text.c_str(), 1, std::nan(""))) << text;
  }
}

}  // namespace
}  // namespace grisaille::lab::claims
