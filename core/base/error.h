// SPDX-License-Identifier: MIT
// Errors with a number. Every failure of the program is an entry of core/base/error_list.h and
// reaches the user as one line: "error E2101: <what and why>; <what to do>".
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace grisaille {

enum class ErrorId : int {
#define GRISAILLE_ERROR(name, number, remedy) name = number,
#include "core/base/error_list.h"
#undef GRISAILLE_ERROR
};

// The remedy for an error, from the list, without a full stop.
std::string_view remedyOf(ErrorId id);

// Replaces control characters and bytes that are not UTF-8 by '?', which keeps text from a file or
// a driver on one line that every reader can decode, and truncates the text to 400 bytes.
std::string oneLine(std::string_view text);

// The exception of all core code. what() returns the full line.
class Error : public std::runtime_error {
 public:
  // `detail` says what failed and why, without a full stop.
  Error(ErrorId id, std::string_view detail);

  template <typename First, typename... Rest>
  Error(ErrorId id, fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest)
      : Error(id, fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...)) {}

  ErrorId id() const { return id_; }
  const std::string& detail() const { return detail_; }

 private:
  ErrorId id_;
  std::string detail_;
};

}  // namespace grisaille
