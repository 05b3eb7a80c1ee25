// SPDX-License-Identifier: MIT
// What a misspelt word meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace grisaille {

// The candidate that `word` most likely meant (edit distance, at most a third of its letters plus
// one wrong), or "" where none is near.
std::string nearest(std::string_view word, std::span<const std::string> candidates);

}  // namespace grisaille
