// SPDX-License-Identifier: MIT
// Touchpads of an X server: two fingers that scroll, and pinches. GLFW reports no pinch, and of a
// scroll only whole notches without their device. This therefore has a connection of its own.
#pragma once

#include <functional>
#include <memory>

#include "app/viewer/fingers.h"

namespace grisaille::app::viewer {

class Touchpad {
 public:
  // Watches the touchpads while the pointer is over an X window. Touchpads may come and go later.
  // Returns null if `window` is 0, without a display, or if the server lacks XInput 2.4 (X.Org
  // 21.1). `wake`: called from another thread when poll() has news; must not call poll() itself.
  static std::unique_ptr<Touchpad> of(unsigned long window, std::function<void()> wake);

  // Destroy it before the window.
  virtual ~Touchpad() = default;

  // What fingers did since the last call. Call it from the thread that created this.
  // `complete`: also waits for the server, for all that it did before the call.
  virtual FingerMove poll(bool complete) = 0;
};

}  // namespace grisaille::app::viewer
