// SPDX-License-Identifier: MIT
// Checks of the arguments that a host passes.
#pragma once

#include <cstdint>

#include "core/base/error.h"

namespace grisaille::host {

// The pointee of `given`. Throws kHostNull if it is null.
template <typename T>
T& present(T* given, const char* name) {
  if (given == nullptr) throw Error(ErrorId::kHostNull, "{} is null", name);
  return *given;
}

// The same for a struct that begins with its size. Also throws kHostStruct unless the size is
// right: each struct has the same size in all versions.
template <typename Struct>
Struct& whole(Struct* given, const char* name) {
  Struct& found = present(given, name);
  if (found.struct_size != sizeof(Struct)) {
    throw Error(ErrorId::kHostStruct, "{}.struct_size is {}, not {}", name, found.struct_size,
                sizeof(Struct));
  }
  return found;
}

// Throws kHostNull if `handle` is null.
void checkHandle(const void* handle, const char* name);

// Throws kHostValue unless value < count.
void checkEnum(uint32_t value, uint32_t count, const char* name);
// Throws kHostValue unless value is 0.
void checkReserved(uint32_t value, const char* name);

}  // namespace grisaille::host
