// SPDX-License-Identifier: MIT
// Shows the progress of long work: a bar on standard error, or lines of JSON on standard output.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace grisaille::app::truth {

// kJson: one object per line, {"progress": name, "share": 0 ... 1, "text": "..."}.
enum class ProgressStyle : uint8_t { kNone, kBar, kJson };

// kBar if standard error is a terminal, else kNone.
ProgressStyle usualProgress();

class Progress {
 public:
  Progress(std::string name, ProgressStyle style) : name_(std::move(name)), style_(style) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  struct State {
    double done = 0, total = 1;  // work since the constructor, in any unit
    std::string text;
  };
  // Draws or prints at most five times a second, however often it is called.
  void show(const State& state);

  // Erases the bar.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  ProgressStyle style_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
};

// "3 s", "4 min 05 s", "2 h 10 min".
std::string durationText(double seconds);

}  // namespace grisaille::app::truth
