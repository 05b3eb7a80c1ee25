// SPDX-License-Identifier: MIT
// Chooses an effect's presets from a study's front.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/settings/presets.h"
#include "app/study/record.h"
#include "app/study/report.h"

namespace grisaille::app::study {

// One setting over all backends. `price.error`: mean of the backends' errors. `price.cost`:
// geometric mean of the backends' costs, each as a multiple of the median cost on its backend,
// since milliseconds of different drivers do not add up. `errors`: means of the backends' too.
struct Choice {
  SettingText setting;
  Price price;
  std::vector<double> errors;  // of each camera
};

// The settings that every backend of the records has measured, in the order of the records.
std::vector<Choice> choicesOf(std::span<const Record> records);

// The settings of a front that are worth their price: whose error is below kWorth times that of the
// next cheaper one that is. Of those whose costs differ by less than clocks do from run to run, the
// dearest.
//
// `front`: indices into `prices`, from frontOf().
constexpr double kWorth = 0.99;
constexpr double kClockNoise = 0.08;  // share of the cost
std::vector<size_t> worthwhile(std::span<const Price> prices, std::span<const size_t> front);

// How much more `dearer` errs than `cheaper` where it does worst: the largest difference of a
// camera's errors. 0 or less: nowhere. `errors`: of each camera, in the same order.
double worstLoss(std::span<const double> dearer, std::span<const double> cheaper);

// Chooses a point of a front (ascending cost) for each of kPresetNames, and returns its index.
//
// - `reference`: the least error, at any cost.
// - `fine`, then `balanced`, then `fast`: the dearest point that costs at most its share of
//   `reference`, see kMostShare.
//
// Where a point would make a dearer preset err more than kMostLoss above it at a camera, so that
// who pays more would get less there, the next cheaper point takes its place. If all points within
// the limit would, the one with the least such loss does. `errors`: see worstLoss(); one per point,
// or none.
//
// A preset with no point below its limit takes its place in an even spread over the front. (Knees
// of the front would be the natural choice, but a front is nearly straight in error and logarithm
// of cost. Its knees jump from one end to the other with the noise of the clock.) Throws
// kFrontSmall for fewer than four points.
constexpr double kMostShare[] = {0.055, 0.13, 0.28};  // of `fast`, `balanced` and `fine`
constexpr double kMostLoss = 0.002;
std::vector<size_t> presetsOn(std::span<const Price> front,
                              std::span<const std::vector<double>> errors = {});

// A preset beside those of kPresetNames: of the settings with this value, the one with the least
// error.
struct NamedPreset {
  std::string name;
  effect::Assignment value;
};

// Parses "NAME=EFFECT.KEY=VALUE". Throws kUsage.
NamedPreset parseNamedPreset(const std::string& text);

// Chooses the presets of an effect from the records and writes the presets file, first those of
// kPresetNames. Throws kFrontSmall, kUsage if the settings are not all of one effect or none has
// the value of `more`, kFileUnwritable.
void writePresets(std::span<const Record> records, std::span<const NamedPreset> more,
                  const std::string& file);

}  // namespace grisaille::app::study
