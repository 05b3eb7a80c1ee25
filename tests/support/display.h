// SPDX-License-Identifier: MIT
// A private X server (Xvfb, or another one) for tests that open windows. The test can read the
// pixels of its screen.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

struct xcb_connection_t;

namespace grisaille::tests {

// Starts a server, without a window manager. Of several objects, the last one must end first.
class Display {
 public:
  // A screen of width x height pixels, 8 bits per channel. While the object lives, DISPLAY of this
  // process and its children names it. Throws std::runtime_error, for example if Xvfb is not
  // installed.
  Display(uint32_t width, uint32_t height);
  // As above, with another server: its command, which takes the option -displayfd.
  explicit Display(std::vector<std::string> command);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  const std::string& name() const { return name_; }  // for example ":5"

  xcb_connection_t* connection() const { return connection_; }

  // Reads a rectangle of the screen: 0xRRGGBB per pixel, top row first.
  std::vector<uint32_t> pixels(uint32_t x, uint32_t y, uint32_t width, uint32_t height) const;

  // Gives the screen a resolution of `scale` times the usual 96 dots per inch, for windows that are
  // opened later.
  void setScale(double scale) const;

  // Stands in for a window manager: marks every window as iconified, or none.
  void markIconified(bool iconified) const;

 private:
  void start(std::vector<std::string> command);
  void connect();
  void stop();

  pid_t server_ = 0;
  std::string name_;
  std::string before_;  // value of DISPLAY to restore
  xcb_connection_t* connection_ = nullptr;
};

}  // namespace grisaille::tests
