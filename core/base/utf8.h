// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace grisaille {

// The first byte that begins no UTF-8 character; std::string_view::npos: all is UTF-8.
size_t invalidUtf8(std::string_view text);

}  // namespace grisaille
