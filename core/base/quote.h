// SPDX-License-Identifier: MIT
// Quoting for a shell.
#pragma once

#include <string>
#include <string_view>

namespace grisaille {

// `text` as one word of a POSIX shell, in single quotes if necessary.
std::string shellQuoted(std::string_view text);

}  // namespace grisaille
