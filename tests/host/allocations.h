// SPDX-License-Identifier: MIT
// Counts C++ allocations of all libraries in the process, which share this program's operator new.
#pragma once

#include <cstddef>

namespace grisaille::tests {

// Counts allocations of the calling thread while it lives. At most one object may exist at a time.
class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  size_t soFar() const;
};

}  // namespace grisaille::tests
