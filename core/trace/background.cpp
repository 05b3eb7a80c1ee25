// SPDX-License-Identifier: MIT
#include "core/trace/background.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace grisaille::trace {
namespace {

thread_local size_t spared = 0;  // cores that loops of this thread leave to others

struct SparesACore {
  size_t before = std::exchange(spared, 1);
  ~SparesACore() { spared = before; }
};

}  // namespace

void leavingACore(const std::function<void()>& work) {
  const SparesACore spares;  // also until `work` throws
  // Embree builds its hierarchies in the arena of the thread that asks for them.
  tbb::task_arena arena(static_cast<int>(loopThreads()));
  arena.execute(work);
}

size_t loopThreads() {
  // glibc opens a file of /sys to tell, which takes longer than a small loop.
  static const size_t cores = std::thread::hardware_concurrency();
  return std::max<size_t>(1 + spared, cores) - spared;
}

}  // namespace grisaille::trace
