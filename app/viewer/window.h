// SPDX-License-Identifier: MIT
// A window and its input events. Call everything from the main thread.
#pragma once

#include <array>
#include <bitset>
#include <deque>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/touchpad.h"
#include "backends/backends.h"
#include "backends/glfw/window.h"

struct GLFWwindow;

namespace grisaille::app::viewer {

// Initialises GLFW while it lives. The constructor throws kNoDisplay.
class WindowLibrary {
 public:
  WindowLibrary();
  ~WindowLibrary();
  // Ends a Window::wait(). From any thread, while a WindowLibrary lives.
  static void wake();
  WindowLibrary(const WindowLibrary&) = delete;
  WindowLibrary& operator=(const WindowLibrary&) = delete;
};

class Window {
 public:
  // Opens a window for a device of this backend. `check`: as in gpu::DeviceOptions. `size`: in the
  // desktop's units. Throws kWindowFailed.
  Window(const backends::Backend& backend, bool check, glm::uvec2 size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // The window as device creation takes it; owned by this.
  backends::Window* surface() { return &*surface_; }
  glm::uvec2 pixels() const;    // size of the framebuffer; 0 while minimised
  glm::uvec2 size() const;      // in the desktop's units
  float scale() const;          // the display's scale of text and sizes, 0.5 ... 4
  glm::ivec2 position() const;  // of its content, in the desktop's units
  void moveTo(glm::ivec2 position);
  // Sets the size, in the desktop's units, at least 1 and at most the room of the screen that the
  // window is on. Does nothing to a window that fills the screen. Returns the size that it asked
  // for.
  glm::uvec2 resize(glm::uvec2 size);
  // Units of the desktop per unit of a display of the usual resolution: 1 where the desktop scales
  // its units itself.
  double unit() const;
  bool closing() const;
  void close();
  void setTitle(const std::string& title);
  bool isFullScreen() const;
  void toggleFullScreen();
  void setClipboard(const std::string& text);

  // Collects events; waits up to `seconds` for the first. True if events came or are left from
  // earlier calls.
  bool wait(double seconds);

  // Passes size, time and events to ImGui. Call before ImGui::NewFrame(), with an InterfaceContext.
  // Stops before an event that would hide an earlier one in the same frame: a click between two
  // frames is not lost.
  void feedInterface();
  bool hasMoreEvents() const { return !events_.empty(); }

  // What fingers on a touchpad did in the last feedInterface(). ImGui has the notches, too.
  const FingerMove& fingers() const { return fingers_; }

  std::vector<std::string> takeDropped();

 private:
  struct Event {
    enum class Type : uint8_t {
      kMove,
      kButton,
      kWheel,
      kFingers,
      kPinch,
      kKey,
      kText
    } type = Type::kMove;
    int code = 0;  // GLFW's number of the button or key
    bool down = false;
    // Cursor in window units; notches of a wheel or of fingers; scale of a pinch in x.
    glm::dvec2 place = glm::dvec2(0);
    unsigned text = 0;  // Unicode code point
  };
  void setCallbacks();
  void takeFingers(size_t before);
  glm::uvec2 room() const;
  bool feed(const Event& event, std::vector<int>& touched);

  GLFWwindow* window_ = nullptr;
  std::optional<glfw::Window> surface_;
  std::unique_ptr<Touchpad> touchpad_;  // null: GLFW reports all there is
  std::deque<Event> events_;
  std::vector<std::string> dropped_;
  bool woken_ = true;
  glm::ivec4 place_ = glm::ivec4(0);  // position and size before full screen
  glm::dvec2 cursor_ = glm::dvec2(-1e6);
  std::array<bool, 5> buttons_{};
  std::bitset<512> keys_;  // held keys, by GLFW's numbers
  bool acted_ = false;     // this frame took a press or a turn of the wheel
  bool moved_ = false;     // the cursor moved in this frame
  FingerMove fingers_;     // in this frame
};

}  // namespace grisaille::app::viewer
