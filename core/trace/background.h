// SPDX-License-Identifier: MIT
// Runs ray tracing in the background of interactive work.
#pragma once

#include <cstddef>
#include <functional>

namespace grisaille::trace {

// Calls work() on this thread. Its parallel loops use all cores except one; on a machine with two
// cores they stay on this thread.
void leavingACore(const std::function<void()>& work);

// Number of threads for a parallel loop that this thread starts, itself included.
size_t loopThreads();

}  // namespace grisaille::trace
