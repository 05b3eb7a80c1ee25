// SPDX-License-Identifier: MIT
#include "host/checks.h"

#include <cmath>

#include "core/objects/object.h"

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

void checkPoint(const grisaille_point& point, size_t index) {
  const double* p = point.position;
  const float* n = point.normal;
  const bool within = std::ranges::all_of(
      point.position, [](double x) { return std::abs(x) <= objects::kFarthestPoint; });
  if (!within) {
    throw Error(ErrorId::kHostValue, "points[{}].position is {}, {}, {}, out of -1e9 to 1e9", index,
                p[0], p[1], p[2]);
  }
  if (!(std::abs(std::hypot(n[0], n[1], n[2]) - 1) <= 1e-3f)) {
    throw Error(ErrorId::kHostValue, "points[{}].normal is {}, {}, {}, whose length is not 1",
                index, n[0], n[1], n[2]);
  }
  if (point.reserved != 0) {
    throw Error(ErrorId::kHostValue, "points[{}].reserved is {}, not 0", index, point.reserved);
  }
}

void checkPrepare(const grisaille_host_prepare& how) {
  checkEnum(how.orthographic, 2, "how.orthographic");
  checkReserved(how.reserved, "how.reserved");
}

void checkFlags(uint32_t flags, const char* name) {
  const uint32_t unknown = flags & ~uint32_t{GRISAILLE_HOST_CHECK};
  if (unknown == 0) return;
  throw Error(ErrorId::kHostValue, "{} has the bits {:#x}, which no flag of this version has", name,
              unknown);
}

void checkReserved(uint32_t value, const char* name) {
  if (value != 0) throw Error(ErrorId::kHostValue, "{} is {}, not 0", name, value);
}

}  // namespace grisaille::host
