// SPDX-License-Identifier: MIT
// Parameter values, one per line: KEY=TEXT as on the command line, or KEY, a zero byte and the
// eight bytes of a number.
#include <algorithm>
#include <cstring>

#include "tests/fuzz/check_values.h"
#include "tests/fuzz/table.h"

namespace grisaille::fuzz {
namespace {

void set(effect::Values& values, std::string_view line) {
  const bool isText = line.find('=') < line.find('\0');
  const std::string_view key = cut(line, isText ? '=' : '\0');
  double number = 0;
  std::memcpy(&number, line.data(), isText ? 0 : std::min(line.size(), sizeof number));
  accepted({ErrorId::kParameterUnknown, ErrorId::kParameterType, ErrorId::kParameterRange}, [&] {
    if (isText) {
      values.set(key, line);
    } else {
      values.set(key, number);
    }
  });
  requireSound(values);
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  static const effect::Effect effect{.desc = &fuzz::kEffect, .path = ""};
  effect::Values values(effect);
  std::string_view rest = fuzz::textOf(data, size);
  while (!rest.empty()) fuzz::set(values, fuzz::cut(rest, '\n'));
  return 0;
}
