// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace grisaille::oracle {

// Calls work(index) for 0 ... count - 1 on all cores, in no order. `work` does not throw and writes
// only what belongs to its index, so that the outcome is the same for any number of threads.
template <typename Work>
void parallelFor(size_t count, const Work& work,
                 size_t threads = std::thread::hardware_concurrency()) {
  constexpr size_t kBlock = 256;
  std::atomic<size_t> next = 0;
  const auto run = [&]() noexcept {
    for (size_t begin = next.fetch_add(kBlock); begin < count; begin = next.fetch_add(kBlock)) {
      for (size_t i = begin; i < std::min(count, begin + kBlock); ++i) work(i);
    }
  };
  std::vector<std::jthread> others;
  for (size_t i = 1; i < std::min(threads, count / kBlock + 1); ++i) others.emplace_back(run);
  run();
}

}  // namespace grisaille::oracle
