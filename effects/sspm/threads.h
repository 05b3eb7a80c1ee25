// SPDX-License-Identifier: MIT
// A parallel loop over all hardware threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace grisaille::sspm {

// Calls work(0) to work(count - 1), on all hardware threads if there is more than one call. If
// calls throw, it makes no further ones, and throws the first exception.
template <typename Work>
void onAllThreads(size_t count, const Work& work) {
  std::atomic<size_t> next = 0;
  std::once_flag failed;
  std::exception_ptr failure;
  const auto run = [&] {
    try {
      for (size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      std::call_once(failed, [&] { failure = std::current_exception(); });
    }
  };
  {
    std::vector<std::jthread> threads;
    const size_t most = std::min<size_t>(std::thread::hardware_concurrency(), count);
    while (threads.size() + 1 < most) threads.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace grisaille::sspm
