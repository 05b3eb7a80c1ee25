// SPDX-License-Identifier: MIT
#include "tests/host/allocations.h"

#include <cstdlib>
#include <new>

namespace grisaille::tests {
namespace {

thread_local bool counting = false;
thread_local size_t counted = 0;

}  // namespace

AllocationCount::AllocationCount() {
  counted = 0;
  counting = true;
}

AllocationCount::~AllocationCount() {
  counting = false;
}

size_t AllocationCount::soFar() const {
  return counted;
}

}  // namespace grisaille::tests

// The sanitizers replace operator new themselves.
#if !SANITIZED
void* operator new(size_t bytes) {
  if (grisaille::tests::counting) ++grisaille::tests::counted;
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
#endif
