// SPDX-License-Identifier: MIT
// What two fingers on a touchpad do, from the numbers of XInput: positions of scroll axes, and the
// scale of a pinch.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace grisaille::app::viewer {

// What fingers did, summed over events.
struct FingerMove {
  bool scrolled = false;  // they scrolled; `notches` may be 0
  // Scrolled distance in notches of a wheel, as GLFW counts them: to the left and up.
  glm::dvec2 notches = glm::dvec2(0);
  double scale = 1;  // distance between the fingers after a pinch, divided by that before; over 0
};

// A scroll axis of an XInput device.
class ScrollAxis {
 public:
  // increment: change of the position that counts as a notch to the right or down; not 0
  explicit ScrollAxis(double increment) : increment_(increment) {}

  // Notches to the left or up since the last position; 0 if that is unknown.
  double moveTo(double position);

  // The position may have changed unseen: it does while another window has the pointer.
  void forget() { last_.reset(); }

 private:
  double increment_;
  std::optional<double> last_;
};

// One pinch after the other. XInput tells the scale since a pinch began.
class PinchScale {
 public:
  void begin() { last_ = 1; }

  // The factor since the last scale; 1 if `scale` is not a finite number over 0.
  double moveTo(double scale);

 private:
  double last_ = 1;
};

}  // namespace grisaille::app::viewer
