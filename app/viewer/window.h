// SPDX-License-Identifier: MIT
// A window, and what people do in it. All of it belongs to the main thread.
#pragma once

#include <array>
#include <bitset>
#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "backends/backends.h"
#include "backends/glfw/window.h"

struct GLFWwindow;

namespace grisaille::app::viewer {

// The window library. Throws kNoDisplay.
class WindowLibrary {
 public:
  WindowLibrary();
  ~WindowLibrary();
  WindowLibrary(const WindowLibrary&) = delete;
  WindowLibrary& operator=(const WindowLibrary&) = delete;
};

class Window {
 public:
  // For a device of this backend. Throws kWindowFailed.
  Window(const backends::Backend& backend, bool check, glm::uvec2 size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // As a device sees it.
  backends::Window* surface() { return &*surface_; }
  glm::uvec2 pixels() const;  // of the picture that fills it; 0 while it is minimised
  glm::uvec2 size() const;    // in the desktop's units
  float scale() const;        // the display's: text and measures are to be so much larger
  bool closing() const;
  void close();
  void setTitle(const std::string& title);
  bool isFullScreen() const;
  void toggleFullScreen();
  void setClipboard(const std::string& text);

  // Takes what has come, waiting up to so many seconds for it. True where something came, or is
  // left from the last time.
  bool wait(double seconds);

  // Before ImGui::NewFrame(), after this process's InterfaceContext was made: size, time, and as
  // many of the events as one frame can tell apart. A click between two frames is not lost.
  void feedInterface();
  bool hasMoreEvents() const { return !events_.empty(); }

  std::vector<std::string> takeDropped();

 private:
  struct Event {
    enum class Type : uint8_t { kMove, kButton, kWheel, kKey, kText } type = Type::kMove;
    int code = 0;  // button, key
    bool down = false;
    glm::dvec2 place = glm::dvec2(0);  // of the cursor, or the wheel's notches
    unsigned text = 0;
  };
  void setCallbacks();
  bool feed(const Event& event, std::vector<int>& touched);

  GLFWwindow* window_ = nullptr;
  std::optional<glfw::Window> surface_;
  std::deque<Event> events_;
  std::vector<std::string> dropped_;
  bool woken_ = true;
  glm::ivec4 place_ = glm::ivec4(0);  // before it filled the screen
  glm::dvec2 cursor_ = glm::dvec2(-1e6);
  std::array<bool, 5> buttons_{};
  std::bitset<512> keys_;  // held down, by GLFW's numbers
  bool acted_ = false;     // something was pressed or turned in this frame
  bool moved_ = false;     // the cursor, in this frame
};

}  // namespace grisaille::app::viewer
