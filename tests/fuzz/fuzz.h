// SPDX-License-Identifier: MIT
// What the fuzz targets share. A target is one LLVMFuzzerTestOneInput(), linked with libFuzzer to
// look for inputs that break something, and with replay.cpp to run those that once did.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/base/error.h"

// libFuzzer's name. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace grisaille::fuzz {

// Where a function was called: a default argument. (Clang 14 lacks std::source_location.)
struct Place {
  const char* file;
  int line;
  static constexpr Place here(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
};

// What must hold of every input. Throws, which no target catches.
void require(bool holds, Place where = Place::here());

// An error that a file or a text may cause: one line, and a number of those.
void requireOwn(const Error& error, std::initializer_list<ErrorId> allowed,
                Place where = Place::here());

// Whether `read` takes the input. Anything that it throws but an error of `allowed` is a fault.
template <typename F>
bool accepted(std::initializer_list<ErrorId> allowed, F&& read, Place where = Place::here()) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    requireOwn(error, allowed, where);
    return false;
  }
}

// The input as text.
std::string_view textOf(const uint8_t* data, size_t size);

// Cuts `rest` at the first `end` and returns what was before it; all, where there is none.
std::string_view cut(std::string_view& rest, char end);

// A file of this process's own folder, written anew; the folder goes at the end of the process.
std::string scratchFile(const std::string& name, std::string_view content);

}  // namespace grisaille::fuzz
