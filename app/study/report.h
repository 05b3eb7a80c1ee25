// SPDX-License-Identifier: MIT
// Writes the results of a study into its folder: results.csv, results.json, front.svg and front.png
// (drawn by gnuplot), and index.html, which holds everything, with pictures.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/study/record.h"

namespace grisaille::app::study {

// The backends of the records, in alphabetical order.
std::vector<std::string> backendsOf(std::span<const Record> records);

struct Price {
  double cost = 0;  // in any unit; 0: unknown, and then on no front
  double error = 0;
};

// The Pareto front: indices of the prices that no other price beats. A price beats another if it is
// lower in cost or error and not higher in the other. Ascending cost; one of several equal prices.
std::vector<size_t> frontOf(std::span<const Price> prices);

// The Pareto front of one backend's records, by cost() and rmse(): indices into `records`.
std::vector<size_t> paretoFront(std::span<const Record> records, const std::string& backend);

// The records with settings that name the same parameters, for example those of one estimator.
struct Kind {
  std::string name;  // the values that only they share, else the names of the parameters
  std::vector<size_t> records;
};

// The kinds of the records, in the order of first occurrence.
std::vector<Kind> kindsOf(std::span<const Record> records);

// The Pareto front of one backend's records of a kind, by cost() and rmse(). Empty if all its
// points are on the backend's own front, which already shows them.
std::vector<size_t> ownFront(std::span<const Record> records, const std::string& backend,
                             const Kind& kind);

// The names of all files that writeReport() can write.
inline constexpr std::array kReportFiles = {"index.html", "results.csv", "results.json",
                                            "front.gp",   "front.svg",   "front.png"};

// Writes the report of a folder's records. Each backend has its own front, and so has each kind of
// setting that is not on it. Throws kFileUnwritable, and as loadAll() does. Without gnuplot, prints
// a note to standard error and writes no plots.
void writeReport(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
