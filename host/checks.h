// SPDX-License-Identifier: MIT
// What is wrong with what a host gives.
#pragma once

#include <cstdint>

#include "core/base/error.h"

namespace grisaille::host {

// Throws kHostNull.
template <typename T>
T& present(T* given, const char* name) {
  if (given == nullptr) throw Error(ErrorId::kHostNull, "{} is null", name);
  return *given;
}

// The same of a struct that begins with its size, and kHostStruct. No version has given any another
// size, so that a size is right or wrong.
template <typename Struct>
Struct& whole(Struct* given, const char* name) {
  Struct& found = present(given, name);
  if (found.struct_size != sizeof(Struct)) {
    throw Error(ErrorId::kHostStruct, "{}.struct_size is {}, not {}", name, found.struct_size,
                sizeof(Struct));
  }
  return found;
}

// Throws kHostNull.
void checkHandle(const void* handle, const char* name);

// Throws kHostValue unless value < count.
void checkEnum(uint32_t value, uint32_t count, const char* name);
void checkReserved(uint32_t value, const char* name);

}  // namespace grisaille::host
