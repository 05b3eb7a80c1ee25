// SPDX-License-Identifier: MIT
// Suggestions for misspelt words.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace grisaille {

// The candidate nearest to `word` by edit distance, or "" if no distance is at most a third of the
// word's length plus 1.
std::string nearest(std::string_view word, std::span<const std::string> candidates);

}  // namespace grisaille
