// SPDX-License-Identifier: MIT
// Counts what is allocated by C++, in whatever library: this program's operator new is theirs.
#pragma once

#include <cstddef>

namespace grisaille::tests {

// Of the calling thread, while it lives. One at a time.
class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  size_t soFar() const;
};

}  // namespace grisaille::tests
