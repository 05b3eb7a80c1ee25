// SPDX-License-Identifier: MIT
#include "app/report/timings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grisaille::app {

std::string timingsCsv(std::span<const gpu::FrameTimes> frames, gpu::Clock clock) {
  std::string csv = "frame,effect,pass,milliseconds,clock\n";
  for (const gpu::FrameTimes& frame : frames) {
    for (const gpu::PassTime& pass : frame.passes) {
      const size_t slash = pass.label.find('/');
      const std::string effect = slash == std::string::npos ? "" : pass.label.substr(0, slash);
      const std::string name =
          slash == std::string::npos ? pass.label : pass.label.substr(slash + 1);
      csv += fmt::format("{},{},{},{:.4f},{}\n", frame.frame, effect, name, pass.milliseconds,
                         gpu::clockName(clock));
    }
  }
  return csv;
}

std::string timingsDoubt(std::span<const gpu::FrameTimes> frames) {
  size_t doubtful = 0;
  double worst = 0;
  for (const gpu::FrameTimes& frame : frames) {
    double sum = 0;
    for (const gpu::PassTime& pass : frame.passes) sum += pass.milliseconds;
    if (frame.wholeMilliseconds <= 0) continue;
    const double off = std::abs(sum / frame.wholeMilliseconds - 1);
    if (off > 0.05) ++doubtful;
    worst = std::max(worst, off);
  }
  if (doubtful == 0) return "";
  return fmt::format(
      "in {} of {} frames, the sum of the passes' times differs from the frame's time by more than "
      "5 % (at most {:.0f} %); the frame has work outside passes, or the machine is busy",
      doubtful, frames.size(), worst * 100);
}

}  // namespace grisaille::app
