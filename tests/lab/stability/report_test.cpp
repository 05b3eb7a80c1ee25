// SPDX-License-Identifier: MIT
// Limits that make a case fail, results kept from an interrupted sweep, and the program itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "lab/stability/comparison.h"
#include "lab/stability/report.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

using namespace lab::stability;
using nlohmann::json;

Result held() {
  Result result{.key = "a key\nof lines", .backends = {}, .between = Apart{.pixels = 6}};
  for (const char* name : {"opengl", "vulkan"}) {
    result.backends.emplace_back();
    result.backends.back().backend = name;
    result.backends.back().oracle = {.pixels = 6144, .largest = 0.004, .percentile99 = 0.001};
  }
  return result;
}

size_t faults(const Result& result, const Case& one = {}) {
  return faultsOf(one, result).size();
}

TEST(Stability, EveryLimitIsALimit) {
  EXPECT_EQ(faults(held()), 0u);
  const auto with = [](auto&& change) {
    Result result = held();
    change(result);
    return result;
  };
  EXPECT_EQ(faults(with([](Result& r) { r.backends[0].nonFinite = 1; })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[1].outside = 1; })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[1].oracle.shareOver = 0.0009; })), 0u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[1].oracle.shareOver = 0.0011; })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.between->shareOver = 0.0011; })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[0].leastOpen = 0.979; })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[0].leastOpen = 0.981; })), 0u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[0].cornerError = 0.021; })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[0].cornerError = std::nan(""); })), 1u);
  EXPECT_EQ(faults(with([](Result& r) { r.backends[0].error = "error E1234: no"; })), 1u);
}

TEST(Stability, AnEdgeAllowsWhatItNames) {
  for (const Edge& edge : edges()) {
    Case one;
    one.edge = edge.key;
    Result result = held();
    result.backends[0].oracle.shareOver = 0.99 * edge.share;
    EXPECT_EQ(faults(result, one), 0u) << edge.key;
    result.backends[0].oracle.shareOver = 1.01 * edge.share;
    EXPECT_EQ(faults(result, one), 1u) << edge.key;
    // Values that are not finite are a fault at an edge too.
    result = held();
    result.backends[0].nonFinite = 1;
    EXPECT_EQ(faults(result, one), 1u) << edge.key;
  }
}

TEST(Stability, DifferencesAreCounted) {
  std::vector<float> all(1000, 0.001f);
  all[3] = 0.5f;
  all[4] = std::numeric_limits<float>::quiet_NaN();
  const Apart apart = apartOf(all);
  EXPECT_EQ(apart.pixels, 1000u);
  EXPECT_EQ(apart.largest, 1);
  EXPECT_FLOAT_EQ(static_cast<float>(apart.percentile99), 0.001f);
  EXPECT_DOUBLE_EQ(apart.shareOver, 0.002);
  const image::Image a{.width = 2, .height = 1, .channels = 2, .pixels = {0, 0.5f, 1, INFINITY}};
  const image::Image b{.width = 2, .height = 1, .channels = 2, .pixels = {0, 0.25f, 1, 1}};
  EXPECT_EQ(differences(a, b), (std::vector<float>{0.25f, 1}));
}

TEST(Stability, ALargePictureIsComparedInTiles) {
  EXPECT_EQ(pixelsToCompare({96, 64}).size(), 6144u);
  const std::vector<glm::ivec2> pixels = pixelsToCompare({7680, 4320});
  EXPECT_GT(pixels.size(), 50000u);
  EXPECT_LT(pixels.size(), 100000u);
  EXPECT_EQ(pixels.front(), glm::ivec2(0, 0));
  EXPECT_EQ(pixels.back(), glm::ivec2(7679, 4319));
}

TEST(Stability, ResultsAreKeptAndDamageIsDoneAgain) {
  const TemporaryFolder folder;
  Result result = held();
  result.backends[0].leastOpen = 0.99;
  result.backends[1].bits = 0xfedcba9876543210u;
  saveResult(folder.path(), result);
  const auto loaded = loadResult(folder.path(), result.key);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->backends, result.backends);
  EXPECT_EQ(loaded->between, result.between);
  EXPECT_FALSE(loadResult(folder.path(), "another"));
  ASSERT_EQ(folder.files().size(), 1u);
  std::ofstream(folder / folder.files()[0]) << "{\"key\":";
  EXPECT_FALSE(loadResult(folder.path(), result.key));
}

TEST(Stability, TheProgramWritesItsTable) {
  const TemporaryFolder folder;
  const Outcome outcome =
      runProgram({"stability", "--only", "bias, m", "--only", "kernel", "--quick", "--out", "out"},
                 folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const json all = json::parse(readFile(folder.path() / "out/stability.json"));
  EXPECT_EQ(all["cases"].size(), 10u);
  for (const json& one : all["cases"]) EXPECT_TRUE(one["faults"].empty()) << one;
  const std::string text = readFile(folder.path() / "out/stability.md");
  EXPECT_NE(text.find("## bias, m"), std::string::npos);
  EXPECT_NE(text.find("**10 of 10 cases hold.**"), std::string::npos);
  const std::string csv = readFile(folder.path() / "out/stability.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 11);
  EXPECT_NE(csv.find("\n\"bias, m\",\"0\",\"classic\",\"\",1,"), std::string::npos) << csv;
  // No other files are left.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path() / "out"), {}), 3);
}

TEST(Stability, TheProgramShowsEdgesAndMovement) {
  const TemporaryFolder folder;
  const Outcome outcome = runProgram({"stability", "--only", "odd scene", "--only", "movement",
                                      "--quick", "--backend", "opengl", "--out", "out"},
                                     folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const json all = json::parse(readFile(folder.path() / "out/stability.json"));
  EXPECT_EQ(all["movements"].size(), 2u);
  for (const json& row : all["movements"]) EXPECT_GT(row["safe_bias_alone"], -1) << row;
  const std::string text = readFile(folder.path() / "out/stability.md");
  EXPECT_NE(text.find("## Bias under a moving camera"), std::string::npos);
  const std::string picture = "pictures/stability/thin-things-before-a-muzzle.png";
  EXPECT_NE(text.find("](" + picture + ")"), std::string::npos);
  // Two pictures of 96 pixels' width differ in a few pixels.
  const image::Image shown = image::read((folder.path() / "out" / picture).string());
  ASSERT_EQ(shown.width, 3u * 96 * 4 + 16);
  size_t off = 0;
  for (uint32_t y = 0; y < shown.height; ++y) {
    for (uint32_t x = 0; x < 96 * 4; ++x) {
      off += std::abs(shown.at(x, y) - shown.at(x + 96 * 4 + 8, y)) > 0.1f ? 1 : 0;
    }
  }
  EXPECT_GT(off, 0u);
  EXPECT_LT(off, size_t{shown.height} * 96 * 4 / 50);
}

TEST(Stability, WhatIsNotThereIsNotRun) {
  const TemporaryFolder folder;
  const Outcome outcome =
      runProgram({"stability", "--only", "kernels", "--out", "out"}, folder.path());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("E5101"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("'kernels'"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
