// SPDX-License-Identifier: MIT
// A study as one self-contained HTML page, and as JSON.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "app/study/record.h"

namespace grisaille::app::study {

// All records as JSON, without pictures. Records on the front of their backend have "front": true.
std::string resultsOf(std::span<const Record> records);

// page.html with the data filled in: a plot of cost against error, and the pictures, numbers and
// command line of each point. `folder`: the study's folder, for the pictures.
std::string pageOf(const std::filesystem::path& folder, std::span<const Record> records);

}  // namespace grisaille::app::study
