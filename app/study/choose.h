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

// One setting, over all backends that measured it: the mean of their errors, and the geometric mean
// of their costs, each as a multiple of the median cost on its backend, since milliseconds of two
// drivers do not add.
struct Choice {
  SettingText setting;
  Price price;
};

// Those settings that every backend of the records has measured, in the order of the records.
std::vector<Choice> choicesOf(std::span<const Record> records);

// A front without the settings that are not worth their price, which err less than the next cheaper
// one that stays by under a hundredth; and, of those left, without those than which the next dearer
// one that stays costs less than kDistinct more, since clocks do not tell these apart. `front`: as
// frontOf() gives it.
constexpr double kWorth = 0.99, kDistinct = 1.08;
std::vector<size_t> thinned(std::span<const Price> prices, std::span<const size_t> front);

// Indices into a front (by cost, ascending) of kPresetNames. `reference` errs least, at any cost;
// `fine` is the dearest that costs at most 1 / kReferenceRatio of it, and going down from there
// each is the dearest that costs at most 1 / kPresetRatio of what the one above may cost. Where
// nothing is so cheap they are spread evenly over the front. (Knees of the front would be the
// natural choice, but a front is nearly straight in error and logarithm of cost, and its knees jump
// from one end to the other with the noise of the clock.) Throws kFrontSmall for fewer than four
// points.
constexpr double kReferenceRatio = 3, kPresetRatio = 2.6;
std::vector<size_t> presetsOn(std::span<const Price> front);

// Writes the presets of the one effect that the settings are of. Throws kFrontSmall, kUsage where
// they are of several effects, kFileUnwritable.
void writePresets(std::span<const Record> records, const std::string& file);

}  // namespace grisaille::app::study
