// SPDX-License-Identifier: MIT
// What a search for a setting starts from, and how it measures a setting.
#pragma once

#include <memory>
#include <vector>

#include "app/study/measurer.h"
#include "app/study/search.h"

namespace grisaille::app::study {

// The starting points of a search, without repetition:
//
// - the setting that the user has: Subject::sets;
// - the same with each preset: every effect with presets takes the preset of that name;
// - the defaults.
//
// Throws kPresetFile.
std::vector<Point> startsOf(const Subject& subject, const std::vector<Axis>& axes);

// Measures the error and the cost of points on one device.
class Bench {
 public:
  // All three must outlive this.
  Bench(const Subject& subject, const std::vector<Axis>& axes, gpu::Device& device)
      : subject_(subject), axes_(axes), measurer_(subject, device) {}

  Setting settingOf(const Point& point) const;

  // Mean RMSE of the subject's views.
  double error(const Point& point);

  // Median of several measurements, milliseconds.
  double cost(const Point& point);

  // Measures in turns with `known`, and scales its cost by the median ratio. Milliseconds.
  double costBeside(const Point& point, const Evaluated& known);

 private:
  static constexpr int kRounds = 3;
  static constexpr size_t kKept = 4;

  // The started chain of a point. Keeps the kKept last used chains, so that the point that others
  // are measured beside stays started.
  effect::Chain& running(const Point& point);

  struct Kept {
    Point point;
    std::unique_ptr<effect::Chain> chain;
  };
  const Subject& subject_;
  const std::vector<Axis>& axes_;
  Measurer measurer_;
  std::vector<Kept> running_;
};

}  // namespace grisaille::app::study
