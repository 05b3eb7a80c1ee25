// SPDX-License-Identifier: MIT
// A study as one page that needs nothing besides itself, and as JSON.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "app/study/record.h"

namespace grisaille::app::study {

// All records as JSON, without pictures; those on their backend's front say so.
std::string resultsOf(std::span<const Record> records);

// HTML (page.html with the data put in): the plot of cost against error, each point's pictures,
// numbers and command line.
std::string pageOf(const std::filesystem::path& folder, std::span<const Record> records);

}  // namespace grisaille::app::study
