// SPDX-License-Identifier: MIT
// Words for a shell.
#pragma once

#include <string>
#include <string_view>

namespace grisaille {

// `text` as one word of a POSIX shell: in single quotes where that is needed.
std::string shellQuoted(std::string_view text);

}  // namespace grisaille
