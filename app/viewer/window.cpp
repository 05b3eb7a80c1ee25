// SPDX-License-Identifier: MIT
#include "app/viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <utility>

#include "app/viewer/camera_control.h"
#include "app/viewer/input.h"
#include "core/base/error.h"

namespace grisaille::app::viewer {
namespace {

std::string lastError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "GLFW gives no reason";
}

Window& windowOf(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

}  // namespace

WindowLibrary::WindowLibrary() {
  glfw::choosePlatform();
  if (glfwInit() != GLFW_TRUE)
    throw Error(ErrorId::kNoDisplay, "cannot open a window: {}", lastError());
}

void WindowLibrary::wake() {
  glfwPostEmptyEvent();
}

WindowLibrary::~WindowLibrary() {
  glfwTerminate();
}

Window::Window(const backends::Backend& backend, bool check, glm::uvec2 size) {
  glfw::hintWindow(backend.name, check);
  window_ = glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), "Grisaille",
                             nullptr, nullptr);
  if (window_ == nullptr) {
    throw Error(ErrorId::kWindowFailed, "cannot open a window for {}: {}", backend.label,
                lastError());
  }
  surface_.emplace(window_);
  glfwSetWindowUserPointer(window_, this);
  setCallbacks();
  touchpad_ = Touchpad::of(glfw::x11Window(window_), WindowLibrary::wake);
}

Window::~Window() {
  touchpad_.reset();
  if (ImGui::GetCurrentContext() != nullptr && ImGui::GetIO().BackendPlatformUserData != nullptr) {
    // A window that follows does not learn of their release.
    for (int key = 0; key <= GLFW_KEY_LAST; ++key) {
      if (keys_[static_cast<size_t>(key)]) sendKey(key, false);
    }
    ImGui_ImplGlfw_Shutdown();
  }
  glfwDestroyWindow(window_);
}

void Window::setCallbacks() {
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    Window& self = windowOf(w);
    const Event event{.type = Event::Type::kMove, .place = {x, y}};
    if (!self.events_.empty() && self.events_.back().type == Event::Type::kMove) {
      self.events_.back() = event;
    } else {
      self.events_.push_back(event);
    }
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
    windowOf(w).events_.push_back(
        {.type = Event::Type::kButton, .code = button, .down = action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
    windowOf(w).events_.push_back({.type = Event::Type::kWheel, .place = {x, y}});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int) {
    if (action == GLFW_REPEAT || key < 0) return;  // ImGui repeats by itself
    windowOf(w).events_.push_back(
        {.type = Event::Type::kKey, .code = key, .down = action == GLFW_PRESS});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned text) {
    windowOf(w).events_.push_back({.type = Event::Type::kText, .text = text});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    Window& self = windowOf(w);
    for (int i = 0; i < count; ++i) self.dropped_.emplace_back(paths[i]);
    self.woken_ = true;
  });
  const auto wake = [](GLFWwindow* w, auto...) { windowOf(w).woken_ = true; };
  glfwSetFramebufferSizeCallback(window_,
                                 [](GLFWwindow* w, int, int) { windowOf(w).woken_ = true; });
  glfwSetWindowRefreshCallback(window_, wake);
  glfwSetWindowContentScaleCallback(window_,
                                    [](GLFWwindow* w, float, float) { windowOf(w).woken_ = true; });
  glfwSetWindowIconifyCallback(window_, [](GLFWwindow* w, int) { windowOf(w).woken_ = true; });
  glfwSetWindowCloseCallback(window_, wake);
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
    Window& self = windowOf(w);
    self.woken_ = true;
    if (focused != GLFW_FALSE) return;
    // A window without focus receives no key releases.
    for (int key = 0; key <= GLFW_KEY_LAST; ++key) {
      if (!self.keys_[static_cast<size_t>(key)]) continue;
      self.events_.push_back({.type = Event::Type::kKey, .code = key, .down = false});
    }
  });
}

glm::uvec2 Window::pixels() const {
  int width = 0, height = 0;
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0) return glm::uvec2(0);
  glfwGetFramebufferSize(window_, &width, &height);
  return {static_cast<uint32_t>(std::max(width, 0)), static_cast<uint32_t>(std::max(height, 0))};
}

glm::uvec2 Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return {static_cast<uint32_t>(std::max(width, 0)), static_cast<uint32_t>(std::max(height, 0))};
}

float Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(std::max(x, y), 0.5f, 4.0f);
}

glm::ivec2 Window::position() const {
  glm::ivec2 place(0);
  glfwGetWindowPos(window_, &place.x, &place.y);
  return place;
}

void Window::moveTo(glm::ivec2 position) {
  glfwSetWindowPos(window_, position.x, position.y);
}

// Size of the screen's part that windows may take, without panels of the desktop.
glm::uvec2 Window::room() const {
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  const glm::ivec2 at = position();
  glm::uvec2 room(0);
  for (int i = 0; i < count; ++i) {
    glm::ivec2 corner(0), size(0);
    glfwGetMonitorWorkarea(all[i], &corner.x, &corner.y, &size.x, &size.y);
    const glm::ivec2 end = corner + size;
    const bool here = at.x >= corner.x && at.y >= corner.y && at.x < end.x && at.y < end.y;
    if (i == 0 || here) room = glm::uvec2(glm::max(size, glm::ivec2(1)));
  }
  return room;
}

glm::uvec2 Window::resize(glm::uvec2 size) {
  const bool fills = isFullScreen() || glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) != 0;
  const glm::uvec2 most = room();
  if (fills || most.x == 0) return this->size();
  const glm::uvec2 next = glm::clamp(size, glm::uvec2(1), most);
  glfwSetWindowSize(window_, static_cast<int>(next.x), static_cast<int>(next.y));
  return next;
}

double Window::unit() const {
  const glm::uvec2 units = size(), framebuffer = pixels();
  if (units.x == 0 || framebuffer.x == 0) return 1;
  return double{scale()} * units.x / framebuffer.x;
}

bool Window::closing() const {
  return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

bool Window::isFullScreen() const {
  return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::toggleFullScreen() {
  if (isFullScreen()) {
    glfwSetWindowMonitor(window_, nullptr, place_.x, place_.y, place_.z, place_.w, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  glfwGetWindowPos(window_, &place_.x, &place_.y);
  glfwGetWindowSize(window_, &place_.z, &place_.w);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::setClipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

// Adds what fingers did. The X server also presses the wheel's buttons for fingers, which GLFW
// reports: takes these events out again, those from number `before` on. By the requests to the
// server, each of the two connections has all that belongs to an event of the other.
void Window::takeFingers(size_t before) {
  if (!touchpad_) return;
  const auto isWheel = [](const Event& event) { return event.type == Event::Type::kWheel; };
  const auto first = [&] { return events_.begin() + static_cast<std::ptrdiff_t>(before); };
  FingerMove move = touchpad_->poll(std::any_of(first(), events_.end(), isWheel));
  if (move.scrolled) {
    const FingerMove more = touchpad_->poll(true);
    move.notches += more.notches;
    move.scale *= more.scale;
    glfwPollEvents();
    events_.erase(std::remove_if(first(), events_.end(), isWheel), events_.end());
  }
  if (move.notches != glm::dvec2(0)) {
    events_.push_back({.type = Event::Type::kFingers, .place = move.notches});
  }
  if (move.scale != 1) events_.push_back({.type = Event::Type::kPinch, .place = {move.scale, 0}});
}

bool Window::wait(double seconds) {
  const size_t before = events_.size();
  if (!events_.empty() || seconds <= 0) {
    glfwPollEvents();
  } else {
    glfwWaitEventsTimeout(seconds);
  }
  takeFingers(before);
  return std::exchange(woken_, false) || !events_.empty();
}

// Passes one event to ImGui. False if it would hide an event that this frame has already taken.
bool Window::feed(const Event& event, std::vector<int>& touched) {
  // Values in `touched` beyond the keys.
  constexpr int kButtons = 1 << 16, kWheel = kButtons << 1, kPinch = kWheel + 1;
  const int name = event.type == Event::Type::kKey ? event.code : kButtons + event.code;
  const bool again = std::ranges::find(touched, name) != touched.end();
  const bool pointed = std::ranges::any_of(touched, [](int one) { return one >= kButtons; });
  const bool isPress = event.type == Event::Type::kKey || event.type == Event::Type::kButton;
  const bool isModifier = event.type == Event::Type::kKey && event.code >= GLFW_KEY_LEFT_SHIFT &&
                          event.code <= GLFW_KEY_RIGHT_SUPER;
  // A modifier or a release after a press would change the meaning of that press in this frame.
  if (acted_ && (isModifier || (isPress && !event.down))) return false;
  const bool turns = event.type == Event::Type::kWheel || event.type == Event::Type::kFingers;
  const bool ofFingers = event.type == Event::Type::kFingers || isOfFingers(event.place);
  if (turns) {
    // A frame takes either of both: a wheel zooms, fingers pan.
    const bool turned = std::ranges::find(touched, kWheel) != touched.end();
    if (turned && fingers_.scrolled != ofFingers) return false;
    fingers_.scrolled = ofFingers;
  }
  acted_ = acted_ || turns || event.type == Event::Type::kPinch || (isPress && event.down);
  switch (event.type) {
    case Event::Type::kMove:
      if (pointed) return false;  // the button or wheel event belongs to the old position
      moved_ = moved_ || cursor_ != event.place;
      cursor_ = event.place;
      return true;
    case Event::Type::kButton:
      // Since ImGui 1.89.7, a control under others takes a press only if it was hovered the frame
      // before.
      if (again || (event.down && moved_)) return false;
      touched.push_back(name);
      if (event.code < 5) buttons_[static_cast<size_t>(event.code)] = event.down;
      return true;
    case Event::Type::kWheel:
    case Event::Type::kFingers:
      touched.push_back(kWheel);
      fingers_.notches += event.place;
      sendWheel(event.place);
      return true;
    case Event::Type::kPinch:
      touched.push_back(kPinch);
      fingers_.scale *= event.place.x;
      return true;
    case Event::Type::kKey:
      if (again) return false;
      touched.push_back(name);
      if (event.code > GLFW_KEY_LAST) return true;
      keys_[static_cast<size_t>(event.code)] = event.down;
      sendKey(event.code, event.down);
      return true;
    case Event::Type::kText:
      ImGui::GetIO().AddInputCharacter(event.text);
      return true;
  }
  return true;
}

void Window::feedInterface() {
  ImGuiIO& io = ImGui::GetIO();
  if (io.BackendPlatformUserData == nullptr) {
    ImGui_ImplGlfw_InitForOther(window_, false);
    prepareInput();
  }
  ImGui_ImplGlfw_NewFrame();
  io.DeltaTime = std::min(io.DeltaTime, 0.05f);  // a slow frame must not make a key repeat
  std::vector<int> touched;
  acted_ = moved_ = false;
  fingers_ = {};
  while (!events_.empty() && feed(events_.front(), touched)) events_.pop_front();
  sendPointer(cursor_);
  for (size_t i = 0; i < buttons_.size(); ++i) sendButton(static_cast<int>(i), buttons_[i]);
  const auto down = [&](size_t left, size_t right) { return keys_[left] || keys_[right]; };
  sendModifiers(down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
                down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
                down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT),
                down(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER));
}

std::vector<std::string> Window::takeDropped() {
  return std::exchange(dropped_, {});
}

}  // namespace grisaille::app::viewer
