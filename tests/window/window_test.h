// SPDX-License-Identifier: MIT
// A display, a folder, and the viewer on every backend.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "core/image/image.h"
#include "tests/support/display.h"
#include "tests/window/driven_viewer.h"

namespace grisaille::tests {

// High enough for the whole panel; the picture is narrow because software renders it.
inline constexpr const char* kWindow = "500x1680";

class WindowTest : public testing::TestWithParam<std::string> {
 protected:
  explicit WindowTest(uint32_t side = 4096) : display_(side, side) {}

  // Cheap settings: the tests check the panel, and software renders.
  std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"--backend", GetParam(), "--size", kWindow};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--set", "ssao.kernel_size=6"});
    return all;
  }
  // Quits the viewer and expects no message of the driver, its validation or the layer.
  static void expectQuits(DrivenViewer& viewer) {
    const Outcome outcome = viewer.quit();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
  // Camera and size of the displayed picture, as arguments of `grisaille render`.
  static std::vector<std::string> view(const DrivenViewer& viewer) {
    const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<int>>();
    return {"--camera", viewer.value("camera"), "--size",
            std::to_string(rect[2] - rect[0]) + "x" + std::to_string(rect[3] - rect[1])};
  }
  static void expectSame(const std::string& a, const std::string& b) {
    const image::Image first = image::read(a), second = image::read(b);
    ASSERT_EQ(first.width, second.width);
    ASSERT_EQ(first.height, second.height);
    EXPECT_EQ(image::compare(first, second).largest, 0);
    float least = 1e9f, most = -1e9f;
    for (const float x : first.pixels) {
      least = std::min(least, x);
      most = std::max(most, x);
    }
    EXPECT_GT(most - least, 0.1f) << "an empty picture";
  }

  Display display_;
  TemporaryFolder folder_;
};

#define GRISAILLE_IN_WINDOWS(Suite)                                              \
  INSTANTIATE_TEST_SUITE_P(Backends, Suite, testing::Values("opengl", "vulkan"), \
                           [](const auto& of) { return of.param; })

// For suites that test the panel, not the window or the picture: every backend draws the panel by
// the same code, and a window takes seconds.
#define GRISAILLE_IN_A_WINDOW(Suite, backend)                         \
  INSTANTIATE_TEST_SUITE_P(Backends, Suite, testing::Values(backend), \
                           [](const auto& of) { return of.param; })

}  // namespace grisaille::tests
