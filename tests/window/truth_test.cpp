// SPDX-License-Identifier: MIT
// The picture beside its truth: displayed numbers and colours match those computed from files.
#include <cmath>
#include <thread>

#include "app/truth/error_map.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

constexpr const char* kRays = "16";  // a pixel; the least

class TruthTest : public WindowTest {
 protected:
  std::vector<std::string> arguments() const {
    return {"--backend",       GetParam(),     "--size", kWindow,
            "--effects",       "ssao",         "--set",  "ssao.kernel_size=6",
            "--compare-truth", "--truth-rays", kRays};
  }
  std::vector<std::string> environment() const { return {"XDG_CACHE_HOME=" + (folder_ / "cache")}; }

  // RMS error of the displayed view, computed from files.
  double expectedRmse(const DrivenViewer& viewer, const image::Image& shown) {
    std::vector<std::string> command = {"truth",         "--radius", viewer.value("truth radius"),
                                        "--samples",     kRays,      "--no-cache",
                                        "--write",       "ao=t.exr", "--write",
                                        "ao_error=e.exr"};
    const auto more = view(viewer);
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = runProgram(command, folder_.path(), environment());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const double rmse = image::compare(shown, image::read(folder_ / "t.exr")).rmse;
    double noise = 0, count = 0;
    for (const float error : image::read(folder_ / "e.exr").pixels) {
      if (std::isnan(error)) continue;
      noise += double{error} * double{error};
      ++count;
    }
    return std::sqrt(rmse * rmse - noise / count);
  }
  static double rmse(const DrivenViewer& viewer) { return std::stod(viewer.value("rmse")); }
};
GRISAILLE_IN_WINDOWS(TruthTest);

TEST_P(TruthTest, WhatIsShownIsTheError) {
  DrivenViewer viewer(folder_, arguments(), environment());
  viewer.untilValue("truth", "done");
  viewer.key("t");
  viewer.untilValue("compare", "false");
  EXPECT_EQ(viewer.value("view"), "color");
  viewer.key("t");
  viewer.untilValue("truth", "done");
  EXPECT_EQ(viewer.value("view"), "error");
  const image::Image errors = image::read(viewer.savePicture());

  // The colours on the screen.
  const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<uint32_t>>();
  const uint32_t width = rect[2] - rect[0], height = rect[3] - rect[1];
  ASSERT_EQ(errors.width, width);
  ASSERT_EQ(errors.height, height);
  viewer.send("mousemove 5 5");
  viewer.untilDrawn();
  const std::vector<uint32_t> screen = display_.pixels(rect[0], rect[1], width, height);
  size_t off = 0, dark = 0, bright = 0;
  for (size_t i = 0; i < screen.size(); ++i) {
    const glm::vec3 color = app::truth::errorColor(errors.pixels[i]) * 255.0f;
    for (int c = 0; c < 3; ++c) {
      off += std::abs(static_cast<float>(screen[i] >> (16 - 8 * c) & 255u) - color[c]) > 1 ? 1 : 0;
    }
    dark += errors.pixels[i] < -0.1f ? 1 : 0;
    bright += errors.pixels[i] > 0.1f ? 1 : 0;
  }
  EXPECT_EQ(off, 0u);
  EXPECT_GT(dark, screen.size() / 100);
  EXPECT_GT(bright, screen.size() / 1000);

  viewer.key("v");
  viewer.untilValue("view", "truth");
  const std::string truth = viewer.savePicture();
  viewer.key("v v");
  viewer.untilValue("view", "ssao.ao");
  const image::Image shown = image::read(viewer.savePicture());
  viewer.untilValue("truth", "done");
  const double expected = expectedRmse(viewer, shown);
  expectSame(truth, folder_ / "t.exr");
  EXPECT_NEAR(rmse(viewer), expected, 1e-5);
  const image::Image exact = image::read(truth);
  for (size_t i = 0; i < errors.pixels.size(); ++i) {
    if (std::isnan(exact.pixels[i])) continue;
    ASSERT_EQ(errors.pixels[i], shown.pixels[i] - exact.pixels[i]) << i;
  }
  expectQuits(viewer);
}

TEST_P(TruthTest, TheOtherSideIsTheTruth) {
  DrivenViewer viewer(folder_, arguments(), environment());
  viewer.untilValue("truth", "done");
  viewer.key("x");
  viewer.untilValue("view right", "truth");
  viewer.key("t");
  viewer.untilValue("view right", "normal");
  EXPECT_EQ(viewer.value("view"), "color");
  expectQuits(viewer);
}

TEST_P(TruthTest, AMovedCameraIsTracedAnewAndASettingIsNot) {
  DrivenViewer viewer(folder_, arguments(), environment());
  viewer.untilValue("truth", "done");
  const double before = rmse(viewer);
  EXPECT_EQ(viewer.value("truths"), "1");
  viewer.drag(viewer.at("ssao.intensity", 0.5, 0.5), viewer.at("ssao.intensity", 0.9, 0.5));
  viewer.untilChanged("ssao.intensity", "1");
  viewer.untilValue("truth", "done");
  const double strong = rmse(viewer);
  EXPECT_GT(std::abs(strong - before), 0.01);
  EXPECT_EQ(viewer.value("truths"), "1");

  viewer.send("mousemove " + std::to_string(viewer.middle("picture").x) + " 600 key Escape");
  viewer.key("Left");
  viewer.untilValue("truths", "2");
  viewer.untilValue("truth", "done");
  viewer.key("v v v");
  viewer.untilValue("view", "ssao.ao");
  viewer.untilValue("truth", "done");
  const image::Image shown = image::read(viewer.savePicture());
  viewer.untilValue("truth", "done");
  // Rounding may move the origins of the rays.
  EXPECT_NEAR(rmse(viewer), expectedRmse(viewer, shown), 2e-5);
  viewer.key("Home");
  viewer.untilValue("truths", "3");
  viewer.untilValue("truth", "done");
  EXPECT_NEAR(rmse(viewer), strong, 1e-6);

  // The viewer is idle now. Afterwards, it quits while it traces.
  const std::string drawn = viewer.value("drawn");
  std::this_thread::sleep_for(std::chrono::seconds(2));
  EXPECT_EQ(viewer.value("drawn"), drawn);
  viewer.key("Left");
  expectQuits(viewer);
}

TEST_P(TruthTest, IsRefusedWithoutAVisibility) {
  const Outcome outcome =
      runProgram({"view", "--backend", GetParam(), "--effects", "sspm", "--compare-truth"},
                 folder_.path(), {"XDG_STATE_HOME=" + (folder_ / "state")});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("visibility"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
