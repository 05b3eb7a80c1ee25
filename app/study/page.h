// SPDX-License-Identifier: MIT
// A study as one page that needs nothing besides itself.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "app/study/record.h"

namespace grisaille::app::study {

// All records as JSON; `pictures`: with their pictures, as data URLs.
std::string pageData(const std::filesystem::path& folder, std::span<const Record> records,
                     bool pictures);

// HTML: the plot of cost against error, each point's pictures, numbers and command line.
std::string pageOf(const std::filesystem::path& folder, std::span<const Record> records);

}  // namespace grisaille::app::study
