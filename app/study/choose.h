// SPDX-License-Identifier: MIT
// Chooses an effect's presets from a study's front.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/presets.h"
#include "app/study/record.h"
#include "app/study/report.h"

namespace grisaille::app::study {

// One setting, over all backends that measured it: the mean of their errors, and the geometric mean
// of their costs, each as a multiple of the median cost on its backend, since milliseconds of two
// drivers do not add.
struct Choice {
  Setting setting;
  Price price;
};

// Those settings that every backend of the records has measured, in the order of the records.
std::vector<Choice> choicesOf(std::span<const Record> records);

// A front without those whose dearer neighbour costs less than this much more: clocks do not tell
// such settings apart, and the dearer one errs less. `front`: as frontOf() gives it.
constexpr double kDistinct = 1.1;
std::vector<size_t> distinct(std::span<const Price> prices, std::span<const size_t> front);

// Indices into a front (by cost, ascending) of kPresetNames. `reference` errs least. `balanced` is
// the knee of the front, the point farthest under the chord between its ends in log(cost) and error
// (Satopaa et al. 2011, "Finding a 'Kneedle' in a Haystack"); `fast` the knee of what is cheaper
// and `fine` of what is dearer, or the neighbour on that side where nothing lies between. Throws
// kFrontSmall for fewer than four points.
std::vector<size_t> presetsOn(std::span<const Price> front);

// Writes the presets of the one effect that the settings are of. Throws kFrontSmall, kUsage where
// they are of several effects, kFileUnwritable.
void writePresets(std::span<const Record> records, const std::string& file);

}  // namespace grisaille::app::study
