// SPDX-License-Identifier: MIT
// Parallel loops whose results do not depend on the number of cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "core/trace/background.h"

namespace grisaille::trace {

// Elements that one thread takes at a time.
constexpr size_t kBlock = 64;
// Blocks for which a loop starts a further thread: this takes as long as some hundred rays.
constexpr size_t kBlocksAThread = 4;

// Calls work(first, count) for blocks of 0 ... total - 1 on loopThreads() threads, in any order. If
// `total` is small, `work` runs on the calling thread. `work` must not throw and must write only
// data of its own indices, which makes the results the same for any number of threads.
//
// The threads end with the loop. TBB's search for more work meanwhile, and take a core from the
// caller's own threads, such as those of an effect between its rays.
template <typename Work>
void forEachBlock(size_t total, const Work& work) {
  const size_t blocks = (total + kBlock - 1) / kBlock;
  std::atomic<size_t> next = 0;
  const auto run = [&] {
    for (size_t block = next++; block < blocks; block = next++) {
      const size_t first = block * kBlock;
      work(first, std::min(kBlock, total - first));
    }
  };
  const size_t most = std::min(loopThreads(), blocks / kBlocksAThread);
  std::vector<std::jthread> others;
  while (others.size() + 1 < most) others.emplace_back(run);
  run();
}

// Calls work(i) for i = 0 ... total - 1, under the rules of forEachBlock().
template <typename Work>
void forEach(size_t total, const Work& work) {
  forEachBlock(total, [&](size_t first, size_t count) {
    for (size_t i = first; i < first + count; ++i) work(i);
  });
}

}  // namespace grisaille::trace
