// SPDX-License-Identifier: MIT
#include "host/checks.h"

namespace grisaille::host {

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
