// SPDX-License-Identifier: MIT
#include "core/base/nearest.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace grisaille {
namespace {

// Edit distance in which an insertion, a deletion, a change and a swap of neighbours each count 1.
size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> beforeLast, last(b.size() + 1), current(b.size() + 1);
  std::iota(last.begin(), last.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], beforeLast[j - 2] + 1);
      }
    }
    beforeLast = std::exchange(last, current);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
  const std::string* best = nullptr;
  size_t least = word.size() / 3 + 2;  // one more than the largest allowed distance
  for (const std::string& candidate : candidates) {
    // Skip by length alone: a key taken from a file may be as long as the file.
    if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) >=
        least) {
      continue;
    }
    const size_t wrong = distance(word, candidate);
    if (wrong < least) {
      least = wrong;
      best = &candidate;
    }
  }
  return best != nullptr ? *best : std::string();
}

}  // namespace grisaille
