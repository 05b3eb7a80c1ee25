// SPDX-License-Identifier: MIT
#include "core/base/error.h"

#include "core/base/utf8.h"

namespace grisaille {
namespace {

std::string message(ErrorId id, std::string_view detail) {
  return fmt::format("error E{}: {}; {}", static_cast<int>(id), oneLine(detail), remedyOf(id));
}

}  // namespace

std::string_view remedyOf(ErrorId id) {
  switch (id) {
#define GRISAILLE_ERROR(name, number, remedy) \
  case ErrorId::name:                         \
    return remedy;
#include "core/base/error_list.h"
#undef GRISAILLE_ERROR
  }
  return "this number is not in the list; report it";
}

std::string oneLine(std::string_view text) {
  constexpr size_t kLongest = 400;
  std::string line(text.substr(0, kLongest));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  // What is cut off in the middle of a character is no UTF-8 either.
  for (size_t at = invalidUtf8(line); at != std::string::npos; at = invalidUtf8(line)) {
    line[at] = '?';
  }
  if (text.size() > kLongest) line += "...";
  return line;
}

Error::Error(ErrorId id, std::string_view detail)
    : std::runtime_error(message(id, detail)), id_(id), detail_(detail) {}

}  // namespace grisaille
