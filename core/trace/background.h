// SPDX-License-Identifier: MIT
// Tracing beside work that must stay quick.
#pragma once

#include <functional>

namespace grisaille::trace {

// Calls work() on this thread. What it does in parallel leaves one core alone; where there are two,
// it stays on this thread.
void leavingACore(const std::function<void()>& work);

}  // namespace grisaille::trace
