// SPDX-License-Identifier: MIT
// Pictures inside a page.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace grisaille::app::study {

// A file of a type ("image/png") as the text that an <img> takes for its source.
std::string dataUrl(std::string_view type, std::span<const std::byte> file);

}  // namespace grisaille::app::study
