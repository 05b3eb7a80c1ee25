// SPDX-License-Identifier: MIT
// An X server of the test's own (Xvfb): windows open there, and what it shows can be read.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

struct xcb_connection_t;

namespace grisaille::tests {

// There is one at a time. It shows windows without a window manager.
class Display {
 public:
  // A screen of width x height pixels, 8 bits a channel. Until the object goes, it is this
  // process's DISPLAY, and its children's. Throws std::runtime_error, as when Xvfb is not there.
  Display(uint32_t width, uint32_t height);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  const std::string& name() const { return name_; }  // ":5"

  // What the screen shows in a rectangle: 0xRRGGBB, the top row first.
  std::vector<uint32_t> pixels(uint32_t x, uint32_t y, uint32_t width, uint32_t height) const;

  // What a window manager does: says that every window is iconified, or that none is.
  void markIconified(bool iconified) const;

 private:
  void start(uint32_t width, uint32_t height);
  void connect();
  void stop();

  pid_t server_ = 0;
  std::string name_;
  std::string before_;  // DISPLAY
  xcb_connection_t* connection_ = nullptr;
};

}  // namespace grisaille::tests
