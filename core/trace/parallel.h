// SPDX-License-Identifier: MIT
// Work on all cores whose outcome does not depend on how many there are.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace grisaille::trace {

// Elements that one thread takes at a time.
constexpr size_t kBlock = 64;

// Calls work(first, count) for blocks of 0 ... total - 1 on all cores, in no order; a block or less
// stays on the calling thread. `work` does not throw and writes only what belongs to its indices,
// so that the outcome is the same for any number of threads.
template <typename Work>
void forEachBlock(size_t total, const Work& work) {
  if (total == 0) return;
  if (total <= kBlock) return work(size_t{0}, total);
  tbb::parallel_for(size_t{0}, (total + kBlock - 1) / kBlock, [&](size_t block) {
    const size_t first = block * kBlock;
    work(first, std::min(kBlock, total - first));
  });
}

template <typename Work>
void forEach(size_t total, const Work& work) {
  forEachBlock(total, [&](size_t first, size_t count) {
    for (size_t i = first; i < first + count; ++i) work(i);
  });
}

}  // namespace grisaille::trace
