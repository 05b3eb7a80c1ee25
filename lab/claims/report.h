// SPDX-License-Identifier: MIT
// Writes the report: claims.html, which embeds its pictures; claims.md with its pictures in
// pictures/claims/; claims.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lab/claims/run.h"

namespace grisaille::lab::claims {

struct ClaimsOfBackend {
  std::string backend, device, driver, clock;
  std::vector<ClaimResult> results;  // one per claim
};

struct ClaimsReport {
  ClaimsFile file;
  std::string command, machine, commit;
  std::vector<ClaimsOfBackend> backends;  // the report shows the first one's pictures
};

// "holds" or "does not hold".
const char* verdictOf(const ClaimResult& result);

// Throws kFileUnwritable.
void writeClaims(const std::filesystem::path& folder, const ClaimsReport& report);

}  // namespace grisaille::lab::claims
