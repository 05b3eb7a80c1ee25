// SPDX-License-Identifier: MIT
// What a study found, as files in its folder: results.csv, results.json, front.svg and front.png
// (by gnuplot), and index.html, which holds everything, pictures and all.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "app/study/record.h"

namespace grisaille::app::study {

// In alphabetical order.
std::vector<std::string> backendsOf(std::span<const Record> records);

struct Price {
  double cost = 0;  // in whatever unit; 0: not known, on no front
  double error = 0;
};

// The Pareto front: indices of those that no other one beats, with less error at no more cost or
// the same at less. By cost, ascending; of equals one.
std::vector<size_t> frontOf(std::span<const Price> prices);

// Of one backend's records, by cost() and rmse().
std::vector<size_t> paretoFront(std::span<const Record> records, const std::string& backend);

// Of one folder's records; each backend has a front of its own. Throws kFileUnwritable. Without
// gnuplot there are no plots, and a note on standard error says so.
void writeReport(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
