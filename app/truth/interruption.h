// SPDX-License-Identifier: MIT
#pragma once

namespace grisaille::app::truth {

// Thrown when a signal ended the work early, after the message to the user. The program exits with
// kStatus.
struct Interrupted {
  static constexpr int kStatus = 130;
};

// While an object of this class lives, the first SIGINT or SIGTERM only sets asked(); a second one
// ends the process. Only one object may live at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool asked();
};

}  // namespace grisaille::app::truth
