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
  // Moves the pointer to where it hovers over nothing.
  static void rest(DrivenViewer& viewer) {
    viewer.send("mousemove 5 5");
    viewer.untilDrawn();
  }
  // Turns the camera, shoots through the middle, and drags ssao.intensity.
  static void change(DrivenViewer& viewer) {
    const std::string camera = viewer.value("camera");
    viewer.key("Left Left");
    viewer.untilChanged("camera", camera);
    viewer.key("space");
    viewer.untilValue("sspm.objects", "1");
    viewer.drag(viewer.at("ssao.intensity", 0.5, 0.5), viewer.at("ssao.intensity", 0.8, 0.5));
    viewer.untilChanged("ssao.intensity", "1");
  }
  // The values of controls, by name.
  static nlohmann::json valuesOf(const DrivenViewer& viewer,
                                 std::initializer_list<const char*> names) {
    nlohmann::json values;
    for (const char* name : names) values[name] = viewer.value(name);
    return values;
  }
  // Closes the sections that are open at first, and opens another one.
  static void openOnly(DrivenViewer& viewer, const std::string& section) {
    for (const char* other : {"section Effects", "section View", "section Objects"}) {
      if (viewer.value(other) != "open" || other == section) continue;
      viewer.click(other);
      viewer.untilValue(other, "closed");
    }
    if (viewer.value(section) == "open") return;
    viewer.click(section);
    viewer.untilValue(section, "open");
  }
  static void fill(DrivenViewer& viewer, const std::string& field, const std::string& text) {
    viewer.clickText(field);
    viewer.key("ctrl+a");
    viewer.type("'" + text + "'");
    viewer.key("Return");
    viewer.untilValue(field, text);
  }
  static void choose(DrivenViewer& viewer, const std::string& combo, const std::string& item) {
    viewer.click(combo);
    viewer.untilThere(combo + "." + item);
    viewer.click(combo + "." + item);
    rest(viewer);
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

}  // namespace grisaille::tests
