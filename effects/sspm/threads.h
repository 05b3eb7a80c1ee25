// SPDX-License-Identifier: MIT
// A parallel loop over all hardware threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace grisaille::sspm {

// Calls work(0) to work(count - 1), on all hardware threads if there is more than one call. `work`
// must not throw.
template <typename Work>
void onAllThreads(size_t count, const Work& work) {
  std::atomic<size_t> next = 0;
  const auto run = [&] {
    for (size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> threads;
  const size_t most = std::min<size_t>(std::thread::hardware_concurrency(), count);
  while (threads.size() + 1 < most) threads.emplace_back(run);
  run();
}

}  // namespace grisaille::sspm
