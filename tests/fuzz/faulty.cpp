// SPDX-License-Identifier: MIT
// A target with a deliberate fault, which the replay must report.
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t*, size_t) {
  grisaille::fuzz::require(false);
  return 0;
}
