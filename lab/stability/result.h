// SPDX-License-Identifier: MIT
// What a case came to on each backend, and whether that is within its limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lab/stability/case.h"

namespace grisaille::lab::stability {

// Two pictures of one size, by the largest difference of a pixel's channels.
struct Apart {
  uint64_t pixels = 0;
  double largest = 0;
  double percentile99 = 0;
  double shareOver = 0;  // of pixels, over kTolerance

  bool operator==(const Apart&) const = default;
};

// `differences`: one a pixel; a value that is not finite counts as 1.
Apart apartOf(std::vector<float> differences);

struct BackendResult {
  std::string backend;
  std::string error;       // why there is no result; "": there is one
  uint64_t nonFinite = 0;  // values, of all outputs that were asked for
  uint64_t outside = 0;    // values outside their range
  double touched = 0;      // share of pixels that the effect does something to: occludes, paints
  uint64_t bits = 0;       // a hash of the compared picture: the same bits, the same number
  Apart oracle;
  std::optional<double> leastOpen;    // where Case::open
  std::optional<double> cornerError;  // where Case::corner, rms
  double seconds = 0;                 // of the picture and the oracle together

  bool operator==(const BackendResult&) const = default;
};

struct Result {
  std::string key;  // what it depends on
  std::vector<BackendResult> backends;
  std::optional<Apart> between;  // the two backends
};

// The limits that it breaks, one line each; none: it holds.
std::vector<std::string> faultsOf(const Case& one, const Result& result);

// FOLDER/<hash of the key>.json, written aside. Throws kFileUnwritable.
void saveResult(const std::filesystem::path& folder, const Result& result);
// None: there is no whole file of this key. Throws kStudyRecord where it is no regular file.
std::optional<Result> loadResult(const std::filesystem::path& folder, const std::string& key);

}  // namespace grisaille::lab::stability
