// SPDX-License-Identifier: MIT
#pragma once

namespace grisaille::app::truth {

// Thrown where a signal ended the work early; what there is to say has been said. The program's
// exit status is kStatus.
struct Interrupted {
  static constexpr int kStatus = 130;
};

// While it lives, the first SIGINT or SIGTERM only asks for an end; the second one ends the process
// as ever. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool asked();
};

}  // namespace grisaille::app::truth
