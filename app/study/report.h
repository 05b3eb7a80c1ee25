// SPDX-License-Identifier: MIT
// What a study found, as files in its folder: results.csv, results.json, front.svg and front.png
// (by gnuplot), and index.html, which holds everything, pictures and all.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
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

// Records whose settings name the same parameters, as those of one estimator do.
struct Kind {
  std::string name;  // what they share of their settings and others do not, else the parameters
  std::vector<size_t> records;
};

// In the order they first come.
std::vector<Kind> kindsOf(std::span<const Record> records);

// The front of one backend's records of a kind, by cost() and rmse(). Empty where the backend's
// whole front holds it, which then says as much.
std::vector<size_t> ownFront(std::span<const Record> records, const std::string& backend,
                             const Kind& kind);

// The names of all files that writeReport() may write.
inline constexpr std::array kReportFiles = {"index.html", "results.csv", "results.json",
                                            "front.gp",   "front.svg",   "front.png"};

// Of one folder's records; each backend has a front of its own, and
// each kind of setting that is not on it. Throws kFileUnwritable. Without
// gnuplot there are no plots, and a note on standard error says so.
void writeReport(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
