// SPDX-License-Identifier: MIT
// What became of claims, as files: claims.html, which needs nothing besides itself; claims.md with
// its pictures in pictures/claims/; claims.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lab/claims/run.h"

namespace grisaille::lab::claims {

struct ClaimsOfBackend {
  std::string backend, device, driver, clock;
  std::vector<ClaimResult> results;  // one a claim
};

struct ClaimsReport {
  ClaimsFile file;
  std::string command, machine, commit;
  std::vector<ClaimsOfBackend> backends;  // pictures are the first one's
};

// "holds" or "does not hold".
const char* verdictOf(const ClaimResult& result);

// Throws kFileUnwritable.
void writeClaims(const std::filesystem::path& folder, const ClaimsReport& report);

}  // namespace grisaille::lab::claims
