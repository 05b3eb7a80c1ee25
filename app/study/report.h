// SPDX-License-Identifier: MIT
// What a study found, as files in its folder: results.csv, results.json, front.svg and front.png
// (by gnuplot), and index.html, which holds everything, pictures and all.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "app/study/record.h"

namespace grisaille::app::study {

// Indices of the records that no other one beats: less error at no more cost, or the same at less.
// By cost, ascending. Those without a cost or an error are on no front.
std::vector<size_t> paretoFront(std::span<const Record> records);

// Of one folder's records; each backend has a front of its own. Throws kFileUnwritable. Without
// gnuplot there are no plots, and a note on standard error says so.
void writeReport(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
