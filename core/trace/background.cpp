// SPDX-License-Identifier: MIT
#include "core/trace/background.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace grisaille::trace {

void leavingACore(const std::function<void()>& work) {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  tbb::task_arena arena(std::max(1, cores - 1));
  arena.execute(work);
}

}  // namespace grisaille::trace
