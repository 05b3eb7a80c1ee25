// SPDX-License-Identifier: MIT
// The viewer without a mouse: the panel, the views and the camera by keys alone.
#include "core/scene/camera.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class KeyboardTest : public WindowTest {
 protected:
  // Moves the focus down until a control has it.
  static void goTo(DrivenViewer& viewer, const std::string& control) {
    constexpr int kMostControls = 80;
    for (int i = 0; i < kMostControls && viewer.value("focus") != control; ++i) {
      viewer.key("Down");
      viewer.untilDrawn();
    }
    ASSERT_EQ(viewer.value("focus"), control);
  }
};
GRISAILLE_IN_WINDOWS(KeyboardTest);

TEST_P(KeyboardTest, ThePanelIsUsed) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}));
  viewer.key("Tab");
  viewer.untilDrawn();
  goTo(viewer, "ssao.radius");
  viewer.key("Return");  // types a value
  viewer.untilDrawn();
  viewer.key("ctrl+a");
  viewer.type("0.75");
  viewer.key("Return");
  viewer.untilValue("ssao.radius", "0.75");
  goTo(viewer, "split");
  viewer.key("space");
  viewer.untilValue("split", "true");
  goTo(viewer, "section Cost");
  viewer.key("space");
  viewer.untilValue("section Cost", "open");
  // Back in the picture: the arrows move the camera again.
  const std::string camera = viewer.value("camera");
  viewer.key("Escape");
  viewer.untilDrawn();
  viewer.key("Escape Left");
  viewer.untilChanged("camera", camera);
  expectQuits(viewer);
}

TEST_P(KeyboardTest, TheCameraIsMoved) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}));
  const auto moved = [&](const std::string& keys) {
    const std::string before = viewer.value("camera");
    viewer.key(keys);
    viewer.untilChanged("camera", before);
    return std::pair(scene::parseCamera(before, "before"),
                     scene::parseCamera(viewer.value("camera"), "after"));
  };
  const auto direction = [](const scene::Camera& camera) {
    return glm::normalize(camera.target - camera.eye);
  };
  const auto [a, b] = moved("Left");  // orbits
  EXPECT_LT(glm::dot(direction(a), direction(b)), 0.9999);
  const auto [c, d] = moved("shift+Left");  // pans
  EXPECT_GT(glm::dot(direction(c), direction(d)), 1 - 1e-12);
  EXPECT_NEAR(glm::dot(direction(c), d.eye - c.eye), 0, 1e-9);
  const auto [e, f] = moved("Prior");  // nearer
  EXPECT_GT(glm::dot(direction(e), f.eye - e.eye), 0);
  const auto [g, h] = moved("Next");  // farther
  EXPECT_LT(glm::dot(direction(g), h.eye - g.eye), 0);
  EXPECT_LT(glm::length(h.eye - e.eye), 0.02 * glm::length(f.eye - e.eye) + 1e-3);
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
