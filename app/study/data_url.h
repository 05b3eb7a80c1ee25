// SPDX-License-Identifier: MIT
// Pictures inside a page.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace grisaille::app::study {

// A PNG as the text that an <img> takes for its source.
std::string pngDataUrl(std::span<const std::byte> png);

}  // namespace grisaille::app::study
