// SPDX-License-Identifier: MIT
#include "host/checks.h"

namespace grisaille::host {

void checkStructSize(const void* bytes, uint32_t size, size_t own, std::span<const size_t> earlier,
                     const char* name) {
  if (size == own || std::ranges::find(earlier, size) != earlier.end()) return;
  // Structs consist of words. A size beyond any later version's is a forgotten struct_size.
  constexpr size_t kMost = 4096;
  if (size < own || size % 4 != 0 || size > kMost) {
    throw Error(ErrorId::kHostStruct, "{}.struct_size is {}, which no version has; this one has {}",
                name, size, own);
  }
  const std::span more(static_cast<const std::byte*>(bytes) + own, size - own);
  const auto set = std::ranges::find_if(more, [](std::byte b) { return b != std::byte{0}; });
  if (set == more.end()) return;
  throw Error(ErrorId::kHostStruct,
              "{}.struct_size is {}, and byte {} is not 0: this version of the library knows {} "
              "bytes, and cannot do what the fields after them ask",
              name, size, set - more.begin() + static_cast<ptrdiff_t>(own), own);
}

void checkHandle(const void* handle, const char* name) {
  if (handle == nullptr) throw Error(ErrorId::kHostNull, "{} is null", name);
}

void checkEnum(uint32_t value, uint32_t count, const char* name) {
  if (value < count) return;
  throw Error(ErrorId::kHostValue, "{} is {}, over {}", name, value, count - 1);
}

void checkReserved(uint32_t value, const char* name) {
  if (value != 0) throw Error(ErrorId::kHostValue, "{} is {}, not 0", name, value);
}

}  // namespace grisaille::host
