// SPDX-License-Identifier: MIT
// The camera follows what the user points at: the surfaces of the picture, found by rays here.
#include <cmath>

#include "tests/window/navigation.h"

namespace grisaille::tests {
namespace {

GRISAILLE_IN_WINDOWS(NavigationTest);

TEST_P(NavigationTest, OrbitTurnsAboutTheSurfaceThatIsPressed) {
  DrivenViewer viewer(folder_, wide());
  for (const glm::dvec2 share : {glm::dvec2(0.25, 0.7), {0.8, 0.85}, {0.45, 0.4}}) {
    const Camera before = cameraOf(viewer);
    const Point from = viewer.at("picture", share.x, share.y);
    const auto pivot = seen(viewer, before, from);
    ASSERT_TRUE(pivot);
    viewer.drag(from, {from.x + 40, from.y + 10});
    const Camera after = cameraOf(viewer);
    EXPECT_GT(glm::length(after.eye - before.eye), 0.1);
    expectAt(viewer, after, *pivot, from);
    EXPECT_NEAR(glm::length(after.eye - *pivot) / glm::length(before.eye - *pivot), 1, 1e-2);
    viewer.key("Home");
    viewer.untilDrawn();
  }
  expectQuits(viewer);
}

TEST_P(NavigationTest, PanAndZoomKeepTheSurfaceUnderThePointer) {
  DrivenViewer viewer(folder_, wide());
  const Point at = viewer.at("picture", 0.3, 0.75);
  Camera camera = cameraOf(viewer);
  const auto surface = seen(viewer, camera, at);
  ASSERT_TRUE(surface);
  const double away = glm::length(camera.eye - *surface);
  camera = turnWheel(viewer, at, 4, 3);
  expectAt(viewer, camera, *surface, at);
  EXPECT_NEAR(glm::length(camera.eye - *surface) / away, std::pow(0.9, 3), 1e-2);
  const Point to = {at.x + 50, at.y - 30};
  viewer.drag(at, to, 2);
  expectAt(viewer, cameraOf(viewer), *surface, to);
  // Two fingers sideways, as X11 tells them, and Shift with a wheel.
  camera = turnWheel(viewer, to, 7, 1);
  const glm::dvec2 side = pixelOf(viewer, camera, *surface);
  EXPECT_NEAR(std::abs(side.x - to.x), 32, 1.5);
  EXPECT_NEAR(side.y, to.y, 1.5);
  const Point now = {static_cast<int>(std::lround(side.x)), to.y};
  camera = turnWheel(viewer, now, 4, 1, "shift");
  const glm::dvec2 up = pixelOf(viewer, camera, *surface);
  EXPECT_NEAR(up.x, now.x, 1.5);
  EXPECT_NEAR(std::abs(up.y - now.y), 32, 1.5);
  expectQuits(viewer);
}

TEST_P(NavigationTest, ADoubleClickFocusesAndOneClickMovesNothing) {
  DrivenViewer viewer(folder_, wide());
  const Point at = viewer.at("picture", 0.7, 0.6);
  const Camera before = cameraOf(viewer);
  const std::string text = viewer.value("camera");
  viewer.click(at);
  viewer.untilDrawn();
  EXPECT_EQ(viewer.value("camera"), text);
  // Far from the first click.
  const Point there = viewer.at("picture", 0.3, 0.8);
  const auto surface = seen(viewer, before, there);
  ASSERT_TRUE(surface);
  viewer.send("mousemove " + std::to_string(there.x) + " " + std::to_string(there.y) +
              " click --repeat 2 --delay 20 1");
  viewer.untilChanged("camera", text);
  const Camera after = cameraOf(viewer);
  const double away = glm::length(before.eye - *surface);
  EXPECT_LT(glm::length(after.target - *surface), 0.02 * away);
  EXPECT_NEAR(glm::length(after.eye - *surface) / away, 0.5, 0.02);
  viewer.key("alt+Left");
  viewer.untilValue("camera", text);
  expectQuits(viewer);
}

TEST_P(NavigationTest, TheCameraHasAnUndoOfItsOwn) {
  DrivenViewer viewer(folder_, wide());
  std::vector<std::string> places = {viewer.value("camera")};
  const auto arrived = [&] {
    viewer.untilChanged("camera", places.back());
    places.push_back(viewer.value("camera"));
  };
  viewer.drag(viewer.at("picture", 0.5, 0.7), viewer.at("picture", 0.6, 0.72));
  arrived();
  viewer.key("f");
  arrived();
  viewer.click("axis +X");
  arrived();
  viewer.key("Home");
  arrived();
  viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.7, 0.5));
  viewer.untilChanged("ssao.radius", "0.5");
  const std::string radius = viewer.value("ssao.radius");
  viewer.key("Escape");
  for (size_t i = places.size() - 1; i > 0; --i) {
    viewer.key("alt+Left");
    viewer.untilValue("camera", places[i - 1]);
  }
  viewer.key("alt+Left");
  viewer.untilDrawn();
  EXPECT_EQ(viewer.value("camera"), places.front());
  for (size_t i = 1; i < places.size(); ++i) {
    viewer.key("alt+Right");
    viewer.untilValue("camera", places[i]);
  }
  EXPECT_EQ(viewer.value("ssao.radius"), radius);
  // Nor does undo of settings move the camera.
  viewer.key("ctrl+z");
  viewer.untilValue("ssao.radius", "0.5");
  EXPECT_EQ(viewer.value("camera"), places.back());
  expectQuits(viewer);
}

TEST_P(NavigationTest, FramesTheSelectionThenTheScene) {
  DrivenViewer viewer(folder_, wide());
  viewer.click("section Effects");  // makes room
  viewer.untilValue("section Effects", "closed");
  viewer.key("Escape b");
  viewer.untilValue("sspm.placing", "true");
  const Point at = viewer.at("picture", 0.4, 0.8);
  const auto surface = seen(viewer, cameraOf(viewer), at);
  ASSERT_TRUE(surface);
  const Camera before = cameraOf(viewer);
  viewer.click(at);
  viewer.untilValue("sspm.objects", "1");
  viewer.key("f");
  viewer.untilChanged("camera", scene::cameraJson(before));
  const Camera selection = cameraOf(viewer);
  EXPECT_LT(glm::length(selection.target - *surface), 0.05);
  viewer.key("f");
  viewer.untilChanged("camera", scene::cameraJson(selection));
  const Camera whole = cameraOf(viewer);
  const glm::ivec4 rect = rectOf(viewer);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point(corner & 1 ? atrium_.bounds.max.x : atrium_.bounds.min.x,
                           corner & 2 ? atrium_.bounds.max.y : atrium_.bounds.min.y,
                           corner & 4 ? atrium_.bounds.max.z : atrium_.bounds.min.z);
    const glm::dvec2 pixel = pixelOf(viewer, whole, point) - glm::dvec2(rect.x, rect.y);
    EXPECT_TRUE(pixel.x >= -1 && pixel.y >= -1 && pixel.x <= rect[2] && pixel.y <= rect[3])
        << pixel.x << ", " << pixel.y;
  }
  EXPECT_GT(glm::dot(scene::worldFromView(whole)[2], scene::worldFromView(before)[2]), 1 - 1e-9);
  expectQuits(viewer);
}

TEST_P(NavigationTest, AnAxisLooksAlongIt) {
  DrivenViewer viewer(folder_, wide());
  for (const std::string axis : {"-Z", "+Y", "+X", "-X"}) {
    const std::string before = viewer.value("camera");
    // The end that faces the user hides the opposite one, and stands for it.
    viewer.click("axis " + (axis == "-X" ? "+X" : axis));
    viewer.untilChanged("camera", before);
    const Camera camera = cameraOf(viewer);
    glm::dvec3 from(0);
    from[axis[1] - 'X'] = axis[0] == '+' ? 1 : -1;
    EXPECT_GT(glm::dot(glm::normalize(camera.eye - camera.target), from), std::cos(0.02)) << axis;
  }
  expectQuits(viewer);
}

// A camera low above the floor, which looks at it.
constexpr const char* kLow =
    R"({"eye": [0, 0.8, 0], "target": [2, 0.1, 0], "up": [0, 1, 0], "fovy_degrees": 50})";

TEST_P(NavigationTest, OrbitStopsAtASurfaceUnlessShiftIsHeld) {
  for (const std::string held : {"", "shift"}) {
    DrivenViewer viewer(folder_, wide({"--camera", kLow}));
    const Point at = viewer.at("picture", 0.5, 0.5);
    const auto move = [&](int y) {
      viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(y));
      viewer.untilDrawn();
    };
    // The structure for rays is built in the background.
    viewer.drag(at, {at.x + 2, at.y});
    std::this_thread::sleep_for(std::chrono::seconds(2));
    move(at.y);
    viewer.send((held.empty() ? "" : "keydown " + held + " ") + "mousedown 1");
    viewer.untilDrawn();
    double lowest = 1e9;
    for (int y = at.y; y > at.y - 300; y -= 30) {
      move(y);
      lowest = std::min(lowest, cameraOf(viewer).eye.y);
    }
    viewer.send("mouseup 1" + (held.empty() ? "" : " keyup " + held));
    viewer.untilDrawn();
    if (held.empty()) {
      EXPECT_GT(lowest, 0) << "below the floor";
      EXPECT_LT(lowest, 0.7) << "it did not move";
    } else {
      EXPECT_LT(lowest, 0);
    }
    expectQuits(viewer);
  }
}

// Half of the distance ahead in a second.
TEST_P(NavigationTest, FlyingIsSlowerNearASurface) {
  std::vector<double> speeds;
  for (const std::string height : {"4", "1.5", "0.5"}) {
    DrivenViewer viewer(
        folder_, wide({"--camera", R"({"eye": [0, )" + height +
                                       R"(, 0], "target": [0.01, 0, 0], "fovy_degrees": 60})"}));
    const double expected = std::stod(height) / 2;
    double speed = 0;
    viewer.send("keydown d");
    viewer.until("a flight", [&](const nlohmann::json& now) {
      if (!now.contains("flying speed")) return false;
      speed = std::stod(now["flying speed"]["value"].get<std::string>());
      return true;
    });
    viewer.send("keyup d");
    EXPECT_NEAR(speed / expected, 1, 0.35) << height;
    speeds.push_back(speed);
    expectQuits(viewer);
  }
  EXPECT_GT(speeds[0], 2 * speeds[1]);
  EXPECT_GT(speeds[1], 2 * speeds[2]);
}

}  // namespace
}  // namespace grisaille::tests
