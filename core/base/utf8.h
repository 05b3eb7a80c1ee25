// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace grisaille {

// Index of the first byte that does not begin a UTF-8 character; std::string_view::npos if all of
// `text` is UTF-8.
size_t invalidUtf8(std::string_view text);

}  // namespace grisaille
