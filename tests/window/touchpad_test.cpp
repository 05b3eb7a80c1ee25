// SPDX-License-Identifier: MIT
// Fingers on a touchpad of a real X server: two pan, a pinch zooms to the pointer.
#include <xcb/xcb.h>

#include <condition_variable>
#include <mutex>

#include "app/viewer/touchpad.h"
#include "tests/support/touchpad_server.h"
#include "tests/window/navigation.h"

namespace grisaille::tests {
namespace {

// Xorg offers DRI2, by which Mesa looks for a graphics card, and prints that there is none.
constexpr const char* kSoftware = "LIBGL_ALWAYS_SOFTWARE=1";
constexpr uint32_t kSide = 1024;  // of the screen, pixels
constexpr double kPanned = 32;    // pixels a notch
constexpr std::chrono::seconds kPatience(60);

class TouchpadTest : public NavigationTest {
 protected:
  void SetUp() override {
    const std::string obstacle = TouchpadServer::obstacle();
    if (!obstacle.empty()) GTEST_SKIP() << obstacle;
    server_.emplace(kSide);
  }
  // Moves the pointer, and lets fingers act there.
  Camera act(DrivenViewer& viewer, Point at, const std::function<void()>& fingers) {
    viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y));
    viewer.untilDrawn();
    // The viewer does not know yet where the scroll axes are: it was not over the window.
    server_->scroll(0.01, 0.01, 1);
    settled(viewer);
    const std::string before = viewer.value("camera");
    fingers();
    viewer.untilChanged("camera", before);
    return settled(viewer);
  }
  // The camera once the viewer has taken all that the server has told it. The server tells keys
  // after what fingers did before; the viewer may take them a frame earlier.
  static Camera settled(DrivenViewer& viewer) {
    std::string last;
    do {
      last = viewer.value("camera");
      for (const std::string bookmark : {"1", "2"}) {
        const std::string message = "bookmark " + bookmark + " set";
        viewer.key("ctrl+" + bookmark);
        viewer.untilValue("message", message);
      }
    } while (viewer.value("camera") != last);
    return cameraOf(viewer);
  }
  TouchpadServer& server() { return *server_; }

 private:
  std::optional<TouchpadServer> server_;
};
GRISAILLE_IN_WINDOWS(TouchpadTest);

TEST_P(TouchpadTest, APinchMovesTowardsTheSurfaceUnderThePointerAndAway) {
  DrivenViewer viewer(folder_, wide(), {kSoftware});
  const Point at = viewer.at("picture", 0.3, 0.75);
  const Camera before = cameraOf(viewer);
  const auto surface = seen(viewer, before, at);
  ASSERT_TRUE(surface);
  const double away = glm::length(before.eye - *surface);
  const Camera near = act(viewer, at, [&] { server().pinch(1.6, 10); });
  expectAt(viewer, near, *surface, at);
  EXPECT_NEAR(glm::length(near.eye - *surface) / away, 1 / 1.6, 1e-2);
  const Camera far = act(viewer, at, [&] { server().pinch(1 / 2.0, 10); });
  expectAt(viewer, far, *surface, at);
  EXPECT_NEAR(glm::length(far.eye - *surface) / away, 2 / 1.6, 2e-2);
  // The desktop's gesture of three fingers is not the viewer's.
  server().pinch(1.6, 5, 3);
  EXPECT_EQ(scene::cameraJson(settled(viewer)), scene::cameraJson(far));
  expectQuits(viewer);
}

// Over a notch, the server also presses the wheel's buttons.
TEST_P(TouchpadTest, TwoFingersPanAndDoNotZoom) {
  DrivenViewer viewer(folder_, wide(), {kSoftware});
  Point at = viewer.at("picture", 0.4, 0.7);
  const auto surface = seen(viewer, cameraOf(viewer), at);
  ASSERT_TRUE(surface);
  // The surface stays under the fingers: it moves against the scroll.
  for (const glm::dvec2 notches : {glm::dvec2(0, 2.5), {-3, 0}, {1.5, -2.25}}) {
    const Camera before = cameraOf(viewer);
    const glm::dvec2 from = pixelOf(viewer, before, *surface);
    const Camera after = act(viewer, at, [&] { server().scroll(notches.x, notches.y, 20); });
    const glm::dvec2 moved = pixelOf(viewer, after, *surface) - from;
    EXPECT_LT(glm::length(moved + kPanned * notches), 2.5) << moved.x << ", " << moved.y;
    EXPECT_NEAR(glm::dot(glm::normalize(before.target - before.eye), after.eye - before.eye), 0,
                1e-9);
    const glm::dvec2 now = pixelOf(viewer, after, *surface);
    at = {static_cast<int>(std::lround(now.x)), static_cast<int>(std::lround(now.y))};
  }
  // A wheel still zooms, right after fingers.
  const Camera before = cameraOf(viewer);
  const Camera after = turnWheel(viewer, at, 4, 2);
  EXPECT_NEAR(glm::length(after.eye - *surface) / glm::length(before.eye - *surface), 0.81, 1e-2);
  expectQuits(viewer);
}

TEST_P(TouchpadTest, WithCtrlAPinchMagnifiesPixels) {
  DrivenViewer viewer(folder_, wide(), {kSoftware});
  openOnly(viewer, "section View");
  const Point at = viewer.middle("picture");
  const std::string camera = viewer.value("camera");
  viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) + " keydown ctrl");
  viewer.untilDrawn();
  server().pinch(2, 10);
  viewer.untilChanged("zoom", "1");
  viewer.send("keyup ctrl");
  settled(viewer);
  EXPECT_NEAR(std::stod(viewer.value("zoom")), 2, 0.01);
  EXPECT_EQ(viewer.value("camera"), camera);
  expectQuits(viewer);
}

// --- The connection to the server, without a viewer

// A window of another client that covers the screen's top left corner.
class PlainWindow {
 public:
  explicit PlainWindow(const Display& display) : x_(display.connection()) {
    const xcb_screen_t* screen = xcb_setup_roots_iterator(xcb_get_setup(x_)).data;
    xcb_create_window(x_, XCB_COPY_FROM_PARENT, window_, screen->root, 0, 0, kSide / 2, kSide / 2,
                      0, XCB_WINDOW_CLASS_INPUT_OUTPUT, screen->root_visual, 0, nullptr);
    xcb_map_window(x_, window_);
    movePointer(10);
  }
  ~PlainWindow() { xcb_destroy_window(x_, window_); }
  PlainWindow(const PlainWindow&) = delete;
  PlainWindow& operator=(const PlainWindow&) = delete;
  uint32_t number() const { return window_; }
  void movePointer(int16_t at) const {
    const uint32_t root = xcb_setup_roots_iterator(xcb_get_setup(x_)).data->root;
    xcb_warp_pointer(x_, XCB_NONE, root, 0, 0, 0, 0, at, at);
    std::free(xcb_get_input_focus_reply(x_, xcb_get_input_focus(x_), nullptr));  // sync
  }

 private:
  xcb_connection_t* x_;
  uint32_t window_ = xcb_generate_id(x_);
};

// Counts calls of `wake`, from any thread.
class Woken {
 public:
  std::function<void()> wake() {
    return [this] {
      const std::lock_guard lock(mutex_);
      ++count_;
      changed_.notify_all();
    };
  }
  bool within(std::chrono::seconds patience) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return std::exchange(count_, 0) > 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

TEST(TouchpadConnection, FingersWakeAndCountOnceOverTheWindowAlone) {
  const std::string obstacle = TouchpadServer::obstacle();
  if (!obstacle.empty()) GTEST_SKIP() << obstacle;
  TouchpadServer server(kSide);
  PlainWindow window(server.display());
  Woken woken;
  const auto touchpad = app::viewer::Touchpad::of(window.number(), woken.wake());
  ASSERT_NE(touchpad, nullptr);
  server.scroll(0.1, 0.1, 1);  // from here on, the positions are known
  touchpad->poll(true);
  server.scroll(-0.5, 2.25, 10);
  EXPECT_TRUE(woken.within(kPatience));
  app::viewer::FingerMove move = touchpad->poll(true);
  EXPECT_TRUE(move.scrolled);
  EXPECT_NEAR(move.notches.x, 0.5, 1e-6);
  EXPECT_NEAR(move.notches.y, -2.25, 1e-6);
  EXPECT_EQ(move.scale, 1);

  server.pinch(1.5, 4);
  EXPECT_TRUE(woken.within(kPatience));
  move = touchpad->poll(true);
  EXPECT_FALSE(move.scrolled);
  EXPECT_NEAR(move.scale, 1.5, 1e-4);

  // Over another window, nothing counts, also not later.
  window.movePointer(kSide - 10);
  server.scroll(0, 50, 10);
  server.pinch(3, 4);
  window.movePointer(10);
  server.scroll(0, 0.5, 1);
  server.scroll(0, 0.25, 1);
  move = touchpad->poll(true);
  EXPECT_NEAR(move.notches.y, -0.25, 1e-6);
  EXPECT_EQ(move.scale, 1);
}

TEST(TouchpadConnection, WithoutATouchpadNothingMoves) {
  EXPECT_EQ(app::viewer::Touchpad::of(0, [] {}), nullptr);
  const Display display(64, 64);  // Xvfb has XInput 2.4
  const PlainWindow window(display);
  const auto touchpad = app::viewer::Touchpad::of(window.number(), [] {});
  ASSERT_NE(touchpad, nullptr);
  const app::viewer::FingerMove move = touchpad->poll(true);
  EXPECT_FALSE(move.scrolled);
  EXPECT_EQ(move.scale, 1);
}

}  // namespace
}  // namespace grisaille::tests
