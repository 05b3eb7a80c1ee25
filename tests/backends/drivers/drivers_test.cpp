// SPDX-License-Identifier: MIT
// Drivers may differ only in how they draw the scene. From the same depth and normals, the effects
// make the same picture on each driver, with the same errors against ray casts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/backends/drivers/agreement.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 640, kHeight = 360;

struct Run {
  std::string scene, effect, preset;
};

std::vector<Run> runs(const std::vector<std::string>& effects) {
  std::vector<Run> all;
  for (const char* scene : {"atrium", "sponza"}) {
    for (const std::string& effect : effects) {
      for (const char* preset : {"fast", "balanced", "fine", "reference"}) {
        all.push_back({scene, effect, preset});
      }
    }
  }
  return all;
}

std::ostream& operator<<(std::ostream& stream, const Run& run) {
  return stream << run.scene << "_" << run.effect << "_" << run.preset;
}

// Data that the tests of a scene share: the scene is loaded and drawn once.
struct Stage {
  std::unique_ptr<DriverSubject> subject;  // null: the scene is missing
  SharedAttachments shared;                // drawn by the first device
};

Stage& stageOf(const std::string& scene) {
  static std::map<std::string, Stage> stages;
  const auto [at, isNew] = stages.try_emplace(scene);
  Stage& stage = at->second;
  if (!isNew) return stage;
  stage.subject = scene == "atrium" ? DriverSubject::atrium(kWidth, kHeight)
                                    : DriverSubject::sponza(kWidth, kHeight);
  if (stage.subject) {
    stage.shared = drawShared(*openDevice(presentDevices().front()), *stage.subject);
  }
  return stage;
}

class DriversTest : public ::testing::TestWithParam<Run> {
 protected:
  void SetUp() override {
    devices_ = presentDevices();
    if (devices_.size() < 2) GTEST_SKIP() << "only one device is present";
    stage_ = &stageOf(GetParam().scene);
    if (!stage_->subject) GTEST_SKIP() << "Sponza is missing";
    registry_.scan(EFFECTS_FOLDER);
  }
  effect::Selection selection() {
    return selectionOf(registry_, {GetParam().effect, GetParam().preset});
  }
  // Expects that two drivers agree on at least 99.9 % of the pixels.
  void expectAgree(const image::Image& a, const image::Image& b, const std::string& label) {
    const double apart = shareApart(a, b);
    std::printf("%s: %.4f %% of pixels differ by more than 2/255\n", label.c_str(), 100 * apart);
    EXPECT_LE(apart, 0.001) << label;
  }

  std::vector<TestDevice> devices_;
  Stage* stage_ = nullptr;
  effect::Registry registry_;
};

class SameInputs : public DriversTest {};
INSTANTIATE_TEST_SUITE_P(, SameInputs, ::testing::ValuesIn(runs({"ssao", "sspm"})),
                         ::testing::PrintToStringParamName());

TEST_P(SameInputs, MakeTheSamePicture) {
  const DriverSubject& subject = *stage_->subject;
  image::Image first;
  for (const TestDevice& device : devices_) {
    image::Image picture = applyShared(*openDevice(device), subject, selection(), stage_->shared);
    if (first.pixels.empty()) {
      first = std::move(picture);
      // The picture is not trivial: a share of its pixels is occluded or painted.
      image::Image nothing = first;
      std::ranges::fill(nothing.pixels, GetParam().effect == "ssao" ? 1.0f : 0.0f);
      EXPECT_GT(shareApart(first, nothing), 0.1);
      continue;
    }
    expectAgree(first, picture, devices_.front().label + " and " + device.label);
  }
}

class WholeFrames : public DriversTest {
 protected:
  static void expectWithin(const std::vector<double>& errors, double share) {
    const auto [least, most] = std::ranges::minmax(errors);
    EXPECT_GT(least, 0.01);
    EXPECT_LE(most, (1 + share) * least);
  }
};
INSTANTIATE_TEST_SUITE_P(, WholeFrames, ::testing::ValuesIn(runs({"ssao"})),
                         ::testing::PrintToStringParamName());

TEST_P(WholeFrames, AreAsFarFromRays) {
  std::vector<double> whole, sameSurface;
  for (const TestDevice& device : devices_) {
    const auto [ao, depth] = drawWhole(*openDevice(device), *stage_->subject, selection());
    const DriverSubject::Errors errors = stage_->subject->errors(ao, depth);
    std::printf("%s: RMSE %.5f, where the ray's surface is seen %.5f (not on %.3f %%)\n",
                device.label.c_str(), errors.whole, errors.sameSurface, 100 * errors.otherSurface);
    whole.push_back(errors.whole);
    sameSurface.push_back(errors.sameSurface);
  }
  // At edges, a driver that snaps coarsely draws another surface than the ray hits.
  expectWithin(whole, 0.02);
  expectWithin(sameSurface, 0.01);
}

TEST(Drivers, AreInstalled) {
  for (const TestDevice& device : testDevices()) {
    const std::string why = whyAbsent(device);
    if (!why.empty()) GTEST_SKIP() << why;
  }
}

}  // namespace
}  // namespace grisaille::tests
