// SPDX-License-Identifier: MIT
#include "tests/host/allocations.h"

#include <cstdlib>
#include <new>

namespace grisaille::tests {
namespace {

thread_local bool counting = false;
thread_local size_t counted = 0;

void* allocate(size_t bytes) {
  if (counting) ++counted;
  return std::malloc(bytes > 0 ? bytes : 1);
}

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

#if !SANITIZED
void* operator new(size_t bytes) {
  if (void* memory = grisaille::tests::allocate(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
#endif
