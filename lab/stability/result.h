// SPDX-License-Identifier: MIT
// The results of a case on each backend, and the check of its limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lab/stability/case.h"

namespace grisaille::lab::stability {

// Statistics of the difference of two pictures of one size. A pixel's difference is the largest of
// its channels.
struct Apart {
  uint64_t pixels = 0;
  double largest = 0;
  double percentile99 = 0;
  double shareOver = 0;  // share of pixels over kTolerance

  bool operator==(const Apart&) const = default;
};

// `differences`: one per pixel; a value that is not finite counts as 1.
Apart apartOf(std::vector<float> differences);

struct BackendResult {
  std::string backend;
  std::string error;       // error that prevented a result; "": none
  uint64_t nonFinite = 0;  // number of values that are not finite, in all outputs read
  uint64_t outside = 0;    // number of values outside their range
  double touched = 0;      // share of pixels that the effect changes: occludes, paints
  uint64_t bits = 0;       // hash of the compared picture
  Apart oracle;
  std::optional<double> leastOpen;    // only with Case::open
  std::optional<double> cornerError;  // only with Case::corner; rms
  double seconds = 0;                 // time of the picture and the oracle together

  bool operator==(const BackendResult&) const = default;
};

struct Result {
  std::string key;  // everything that the result depends on
  std::vector<BackendResult> backends;
  std::optional<Apart> between;  // difference between the two backends
};

// The limits that the case exceeds, one line each; empty if it holds.
std::vector<std::string> faultsOf(const Case& one, const Result& result);

// Writes FOLDER/<hash of the key>.json atomically. Throws kFileUnwritable.
void saveResult(const std::filesystem::path& folder, const Result& result);
// None if there is no complete file with this key. Throws kStudyRecord if it is not a regular file.
std::optional<Result> loadResult(const std::filesystem::path& folder, const std::string& key);

}  // namespace grisaille::lab::stability
