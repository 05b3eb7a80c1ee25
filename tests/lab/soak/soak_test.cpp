// SPDX-License-Identifier: MIT
// The plan of a soak, and how its frames and its memory are judged.
#include "lab/soak/soak.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grisaille::lab::soak {
namespace {

size_t countOf(const std::vector<Due>& all, Event event) {
  return static_cast<size_t>(std::ranges::count(all, event, &Due::event));
}

TEST(SoakPlan, EveryKindOfEventHappensInItsTime) {
  for (const double minutes : {0.05, 1.0, 10.0}) {
    const std::vector<Due> all = schedule({.minutes = minutes});
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, &Due::second));
    EXPECT_GE(all.front().second, 0);
    for (const Event event : {Event::kUndo, Event::kLoadObjects, Event::kReloadEffects,
                              Event::kResize, Event::kSaveObjects}) {
      EXPECT_GE(countOf(all, event), 2u) << static_cast<int>(event);
    }
    EXPECT_GE(countOf(all, Event::kRedo), 1u);
    EXPECT_EQ(countOf(all, Event::kSaveObjects), countOf(all, Event::kLoadObjects));
    // A file is there before it is loaded.
    size_t saved = 0, loaded = 0;
    for (const Due& due : all) {
      saved += due.event == Event::kSaveObjects;
      loaded += due.event == Event::kLoadObjects;
      EXPECT_LE(loaded, saved);
    }
  }
  EXPECT_GT(countOf(schedule({.minutes = 10}), Event::kUndo), 50u);
}

TEST(SoakPlan, ASeedRepeatsIt) {
  const auto seconds = [](uint32_t seed) {
    std::vector<double> all;
    for (const Due& due : schedule({.seed = seed})) all.push_back(due.second);
    return all;
  };
  EXPECT_EQ(seconds(1), seconds(1));
  EXPECT_NE(seconds(1), seconds(2));
}

TEST(SoakPlan, EveryResizeIsToAnotherSize) {
  const Plan plan;
  const std::vector<glm::uvec2> sizes = sizesOf(plan);
  uint32_t before = 0;
  for (const Due& due : schedule(plan)) {
    if (due.event != Event::kResize) continue;
    ASSERT_LT(due.amount, sizes.size());
    EXPECT_NE(due.amount, before);
    before = due.amount;
  }
}

TEST(SoakPlan, TheCameraMovesAndStaysNear) {
  const scene::Camera start = scene::atriumCamera();
  double farthest = 0;
  for (int i = 0; i < 1000; ++i) {
    const double second = 0.1 * i;
    const scene::Camera camera = cameraAt(start, second, 1);
    EXPECT_NO_THROW(scene::validate(camera)) << second;
    farthest = std::max(farthest, glm::length(camera.eye - start.eye));
  }
  EXPECT_GT(farthest, 0.5);
  EXPECT_LE(farthest, 1);
}

// A soak whose frames take 10 ms, and whose memory stays at 100 MiB.
Outcome even() {
  Outcome outcome;
  for (int i = 0; i < 100; ++i) {
    const glm::uvec2 size = i < 50 ? glm::uvec2(64, 36) : glm::uvec2(32, 18);
    const double took = i < 50 ? 10 : 4;
    outcome.frames.push_back(
        {.kind = Kind::kQuiet, .second = 0.01 * i, .size = size, .wall = took, .processor = took});
    outcome.samples.push_back(
        {.second = 1.0 * i, .shots = 5, .memory = 100, .givenUp = i > 9 ? 1u : 0u});
  }
  return outcome;
}

TEST(SoakFaults, AnEvenSoakHasNone) {
  EXPECT_EQ(faultsOf(even()), std::vector<std::string>());
}

TEST(SoakFaults, AFrameOverTwiceTheMedianOfItsSizeIsOne) {
  Outcome outcome = even();
  outcome.frames[70].wall = 9;  // under the median of the other size
  ASSERT_EQ(faultsOf(outcome).size(), 1u);
  EXPECT_NE(faultsOf(outcome)[0].find("0.70 s"), std::string::npos) << faultsOf(outcome)[0];
  EXPECT_NE(faultsOf(outcome)[0].find("2.25 times"), std::string::npos) << faultsOf(outcome)[0];
  outcome.frames[70].again = 7;
  ASSERT_EQ(faultsOf(outcome).size(), 1u);
  EXPECT_NE(faultsOf(outcome)[0].find("once more without new shots: 7.0 ms"), std::string::npos);
  outcome.software = true;  // there, the processor's time counts
  EXPECT_TRUE(faultsOf(outcome).empty());
  outcome.frames[70].processor = 9;
  EXPECT_EQ(faultsOf(outcome).size(), 1u);
  for (const Kind kind : {Kind::kPlaces, Kind::kReload, Kind::kResize}) {
    outcome.frames[70].kind = kind;
    EXPECT_TRUE(faultsOf(outcome).empty());
  }
}

TEST(SoakFaults, AViewThatTakesAsLongWithoutNewShotsIsNamedInstead) {
  Outcome outcome = even();
  EXPECT_NE(tableOf(outcome).find("because of the view: 0;"), std::string::npos);
  outcome.frames[70].wall = 9;
  outcome.frames[70].again = 7.5;
  EXPECT_EQ(faultsOf(outcome), std::vector<std::string>());
  EXPECT_NE(tableOf(outcome).find("because of the view: 1; at most 2.25 medians, 1.20 times the "
                                  "view without new shots; at second 0.70\n"),
            std::string::npos)
      << tableOf(outcome);
}

TEST(SoakFaults, FramesThatAllPlaceShotsProveNothing) {
  Outcome outcome = even();
  for (Frame& frame : outcome.frames) frame.kind = Kind::kPlaces;
  EXPECT_EQ(faultsOf(outcome).size(), 1u);
}

TEST(SoakFaults, MemoryThatGrowsAtTheLimitIsOne) {
  Outcome outcome = even();
  for (size_t i = 0; i < 10; ++i) outcome.samples[i].memory = 10;  // below the limit it may grow
  EXPECT_TRUE(faultsOf(outcome).empty());
  for (size_t i = 60; i < 100; ++i) outcome.samples[i].memory = 120;
  ASSERT_EQ(faultsOf(outcome).size(), 1u);
  EXPECT_NE(faultsOf(outcome)[0].find("100 to 120 MiB"), std::string::npos);
  for (Sample& sample : outcome.samples) sample.givenUp = 0;
  ASSERT_EQ(faultsOf(outcome).size(), 1u);
  EXPECT_NE(faultsOf(outcome)[0].find("is not reached"), std::string::npos);
}

}  // namespace
}  // namespace grisaille::lab::soak
