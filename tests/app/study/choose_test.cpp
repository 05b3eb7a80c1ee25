// SPDX-License-Identifier: MIT
#include "app/study/choose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app::study {
namespace {

Record record(const std::string& backend, double cost, double error, const std::string& value) {
  Record r;
  r.study = "scene 1\nsize 8x8\n";
  r.backend = backend;
  r.setting = {{{"ssao", "kernel_size"}, value}};
  r.errors = {{"", "one", error, 0, 0, 0, 1}};
  r.milliseconds = {{cost}};
  return r;
}

TEST(Presets, AreOnTheFrontAndInOrder) {
  std::mt19937 random(2);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Price> front;
    double cost = 1, error = 1;
    for (size_t i = 0; i < 4 + random() % 12; ++i) {
      front.push_back({cost *= 1.01 + unit(), error *= 0.5 + 0.49 * unit()});
    }
    const std::vector<size_t> chosen = presetsOn(front);
    ASSERT_EQ(chosen.size(), 4u);
    EXPECT_TRUE(std::ranges::is_sorted(chosen, std::ranges::less_equal()));
    EXPECT_EQ(std::ranges::adjacent_find(chosen), chosen.end())
        << "two presets are the same setting";
    EXPECT_EQ(chosen[3], front.size() - 1);
  }
  EXPECT_ERROR(ErrorId::kFrontSmall, presetsOn(std::vector<Price>(3, {1, 1})));
}

TEST(Presets, EachCostsAtMostItsShareOfTheDearest) {
  std::vector<Price> front;
  for (int i = 0; i <= 10; ++i) front.push_back({std::exp2(i), 1 - 0.05 * i});
  // With 1024 as the highest cost, the others may cost at most 56, 133 and 286.
  EXPECT_EQ(presetsOn(front), (std::vector<size_t>{5, 7, 8, 10}));
  // Without cheap settings, the presets are spread evenly.
  front = {{40, 0.9}, {45, 0.8}, {50, 0.7}, {60, 0.6}, {100, 0.5}};
  EXPECT_EQ(presetsOn(front), (std::vector<size_t>{0, 1, 3, 4}));
}

TEST(Presets, NoCameraPaysMoreForLess) {
  std::vector<Price> front;
  std::vector<std::vector<double>> errors;
  for (int i = 0; i <= 10; ++i) {
    front.push_back({std::exp2(i), 1 - 0.05 * i});
    errors.push_back({front.back().error, front.back().error});
  }
  EXPECT_EQ(presetsOn(front, errors), (std::vector<size_t>{5, 7, 8, 10}));
  // Point 8 errs far less at one camera than the dearest: another takes its place as `fine`.
  errors[8][1] = 0.1;
  EXPECT_EQ(presetsOn(front, errors), (std::vector<size_t>{5, 6, 7, 10}));
  // Within the margin it may.
  errors[8][1] = 0.5 - 0.9 * kMostLoss;
  EXPECT_EQ(presetsOn(front, errors), (std::vector<size_t>{5, 7, 8, 10}));
  // If every point does, the one with the least loss is chosen.
  for (size_t i = 0; i < 10; ++i)
    errors[i][0] = i == 5 ? 0.4 : 0.3 + 0.001 * static_cast<double>(i);
  EXPECT_EQ(presetsOn(front, errors)[2], 5u);
}

TEST(Presets, WhatErrsHardlyLessIsNotWorthItsPrice) {
  const std::vector<Price> prices = {{1, 0.9}, {2, 0.8}, {3, 0.797}, {4, 0.6}, {5, 0.5999}};
  EXPECT_EQ(worthwhile(prices, frontOf(prices)), (std::vector<size_t>{0, 1, 3}));
}

// As the clock may have it the other way round, the one that errs less is taken.
TEST(Presets, OfSettingsThatCostTheSameTheBetterOneIsWorthIt) {
  const std::vector<Price> prices = {{1, 0.9}, {1.08, 0.8}, {1.15, 0.7}, {2, 0.6}, {2.1, 0.5}};
  EXPECT_EQ(worthwhile(prices, frontOf(prices)), (std::vector<size_t>{1, 2, 4}));
}

// Each error is near the next. Those that remain are apart, and no gap becomes wider than
// necessary.
TEST(Presets, AChainOfNearErrorsIsThinnedOut) {
  std::vector<Price> prices;
  for (int i = 0; i < 40; ++i) {
    prices.push_back({.cost = std::pow(1.2, i), .error = std::pow(0.994, i)});
  }
  const std::vector<size_t> worth = worthwhile(prices, frontOf(prices));
  ASSERT_GT(worth.size(), 10u);
  EXPECT_EQ(worth.front(), 0u);
  for (size_t i = 1; i < worth.size(); ++i) {
    const double ratio = prices[worth[i]].error / prices[worth[i - 1]].error;
    EXPECT_LT(ratio, kWorth);
    EXPECT_GT(ratio, kWorth * kWorth);
  }
}

TEST(Presets, CostsOfTwoBackendsAreShares) {
  // One backend is ten times slower. It did not measure one setting, which is therefore no
  // candidate.
  const std::vector<Record> records = {
      record("opengl", 1, 0.4, "1"), record("opengl", 2, 0.2, "2"), record("opengl", 4, 0.1, "4"),
      record("vulkan", 40, 0.1, "4"), record("vulkan", 20, 0.2, "2")};
  const std::vector<Choice> choices = choicesOf(records);
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_NEAR(choices[1].price.cost / choices[0].price.cost, 2, 1e-12);
  EXPECT_DOUBLE_EQ(choices[1].price.error, 0.1);
}

TEST(Presets, FileHoldsWhatWasChosen) {
  const tests::TemporaryFolder folder;
  std::vector<Record> records;
  for (int i = 1; i <= 32; i *= 2) {
    records.push_back(record("opengl", i, 0.5 / i, std::to_string(i)));
  }
  records.push_back(record("opengl", 100, 0.4, "3"));  // beaten by another
  NamedPreset other = parseNamedPreset("few=ssao.kernel_size=2");
  writePresets(records, {&other, 1}, folder / "p.toml");
  const std::string text = tests::readFile(folder / "p.toml");
  for (const char* name : kPresetNames) {
    EXPECT_NE(text.find(fmt::format("[{}]", name)), std::string::npos) << text;
  }
  EXPECT_NE(text.find("values = {kernel_size = 32}"), std::string::npos) << text;
  EXPECT_EQ(text.find("kernel_size = 3}"), std::string::npos) << text;
  EXPECT_NE(text.find("cost = 1.0000"), std::string::npos) << text;
  EXPECT_NE(text.find("[few]\nerror = 0.25000"), std::string::npos) << text;
  other.value.value = "3000";
  EXPECT_ERROR(ErrorId::kUsage, writePresets(records, {&other, 1}, folder / "q.toml"));
  for (const char* wrong :
       {"few", "few=2", "few=ssao.kernel_size", "Few=ssao.kernel_size=2", "=ssao.kernel_size=2",
        "fine=ssao.kernel_size=2", "few=kernel_size=2"}) {
    EXPECT_ERROR(ErrorId::kUsage, parseNamedPreset(wrong));
  }
  records[0].setting = {{{"other", "size"}, "1"}};
  EXPECT_ERROR(ErrorId::kUsage, writePresets(records, {}, folder / "q.toml"));
}

}  // namespace
}  // namespace grisaille::app::study
