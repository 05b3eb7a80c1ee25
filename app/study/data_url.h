// SPDX-License-Identifier: MIT
// Data URLs, for pictures inside an HTML page.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace grisaille::app::study {

// The contents of a file as a data URL. `type`: its MIME type, e.g. "image/png".
std::string dataUrl(std::string_view type, std::span<const std::byte> file);

}  // namespace grisaille::app::study
