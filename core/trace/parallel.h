// SPDX-License-Identifier: MIT
// Parallel loops whose results do not depend on the number of cores.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace grisaille::trace {

// Elements that one thread takes at a time.
constexpr size_t kBlock = 64;

// Calls work(first, count) for blocks of 0 ... total - 1 on all cores, in any order. If `total` is
// at most kBlock, `work` runs on the calling thread. `work` must not throw and must write only data
// of its own indices, which makes the results the same for any number of threads.
template <typename Work>
void forEachBlock(size_t total, const Work& work) {
  if (total == 0) return;
  if (total <= kBlock) return work(size_t{0}, total);
  tbb::parallel_for(size_t{0}, (total + kBlock - 1) / kBlock, [&](size_t block) {
    const size_t first = block * kBlock;
    work(first, std::min(kBlock, total - first));
  });
}

// Calls work(i) for i = 0 ... total - 1, under the rules of forEachBlock().
template <typename Work>
void forEach(size_t total, const Work& work) {
  forEachBlock(total, [&](size_t first, size_t count) {
    for (size_t i = first; i < first + count; ++i) work(i);
  });
}

}  // namespace grisaille::trace
