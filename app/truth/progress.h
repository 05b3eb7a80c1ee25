// SPDX-License-Identifier: MIT
// A bar on standard error.
#pragma once

#include <chrono>
#include <string>

namespace grisaille::app::truth {

class Progress {
 public:
  // Draws nothing unless `shown`.
  Progress(std::string name, bool shown) : name_(std::move(name)), shown_(shown) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  struct State {
    double done = 0, total = 1;  // of the work that this object has seen the whole of
    std::string text;
  };
  // Draws some times a second, however often it is called.
  void show(const State& state);

  // Takes the bar off the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  bool shown_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
};

// "3 s", "4 min 05 s", "2 h 10 min".
std::string durationText(double seconds);

}  // namespace grisaille::app::truth
