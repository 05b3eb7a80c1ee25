// SPDX-License-Identifier: MIT
#include "app/truth/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace grisaille::app::truth {

ProgressStyle usualProgress() {
  return isatty(STDERR_FILENO) == 1 ? ProgressStyle::kBar : ProgressStyle::kNone;
}

void Progress::show(const State& state) {
  constexpr double kPause = 0.2;  // seconds
  constexpr size_t kCells = 24;
  const Clock::time_point now = Clock::now();
  if (style_ == ProgressStyle::kNone) return;
  if (std::chrono::duration<double>(now - last_).count() < kPause) return;
  last_ = now;
  const double share = std::clamp(state.done / std::max(state.total, 1e-9), 0.0, 1.0);
  if (style_ == ProgressStyle::kJson) {
    const nlohmann::json line = {{"progress", name_}, {"share", share}, {"text", state.text}};
    fmt::print("{}\n", line.dump());
    std::fflush(stdout);
    return;
  }
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const auto full = static_cast<size_t>(share * kCells);
  const std::string left =
      share > 0 ? ", " + durationText(seconds / share - seconds) + " left" : std::string();
  fmt::print(stderr, "\r{} [{}{}] {:3.0f} % {}{}\x1b[K", name_, std::string(full, '#'),
             std::string(kCells - full, '.'), 100 * share, state.text, left);
  std::fflush(stderr);
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

std::string durationText(double seconds) {
  const auto whole = static_cast<long>(std::min(seconds + 0.5, 1e9));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace grisaille::app::truth
