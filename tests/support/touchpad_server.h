// SPDX-License-Identifier: MIT
// An X server with a touchpad that the test moves: Xorg with the drivers dummy, for a screen
// without a graphics card, and inputtest, which takes events from a socket.
#pragma once

#include <string>

#include "tests/program/run.h"
#include "tests/support/display.h"

namespace grisaille::tests {

class TouchpadServer {
 public:
  // Why this machine cannot run one; "": it can.
  static std::string obstacle();

  // A screen of side x side pixels. Throws std::runtime_error.
  explicit TouchpadServer(uint32_t side);
  ~TouchpadServer();
  TouchpadServer(const TouchpadServer&) = delete;
  TouchpadServer& operator=(const TouchpadServer&) = delete;

  const Display& display() const { return display_; }

  // The functions return once the server has handled the events.
  // Two fingers scroll, in notches of a wheel to the right and down.
  void scroll(double right, double down, int steps);
  // A whole pinch of so many fingers. scale: distance between them at its end, 1 at its begin
  void pinch(double scale, int steps, int fingers = 2);

 private:
  template <typename Event>
  void send(Event event, int type) const;
  void wait() const;

  TemporaryFolder folder_;
  Display display_;
  int socket_ = -1;
};

}  // namespace grisaille::tests
