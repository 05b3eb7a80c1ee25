// SPDX-License-Identifier: MIT
// What a claim was measured to be, kept until the report is written: claims take minutes, and a run
// that is interrupted or killed goes on from those that it had done.
#pragma once

#include <filesystem>
#include <optional>

#include "lab/claims/run.h"

namespace grisaille::lab::claims {

// `key` says all that the result depends on. Throws kFileUnwritable.
void saveClaim(const std::filesystem::path& folder, const std::string& key,
               const ClaimResult& result);

// None where there is no whole result of this key. Throws kStudyRecord where its file is no regular
// file.
std::optional<ClaimResult> loadClaim(const std::filesystem::path& folder, const std::string& key);

}  // namespace grisaille::lab::claims
