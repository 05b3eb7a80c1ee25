// SPDX-License-Identifier: MIT
// Saves each claim's result until the report is written. Claims take minutes, and an interrupted
// command goes on after the claims that it has finished.
#pragma once

#include <filesystem>
#include <optional>

#include "lab/claims/run.h"

namespace grisaille::lab::claims {

// `key` is a text that contains everything that the result depends on. Throws kFileUnwritable.
void saveClaim(const std::filesystem::path& folder, const std::string& key,
               const ClaimResult& result);

// None if there is no complete result with this key. Throws kStudyRecord if the file is not a
// regular file.
std::optional<ClaimResult> loadClaim(const std::filesystem::path& folder, const std::string& key);

}  // namespace grisaille::lab::claims
