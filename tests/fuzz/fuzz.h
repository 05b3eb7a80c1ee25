// SPDX-License-Identifier: MIT
// Helpers shared by the fuzz targets. A target is one LLVMFuzzerTestOneInput(). It is linked with
// libFuzzer to search for failing inputs, or with replay.cpp to run the corpus.
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

// The place of a call, as a default argument. (Clang 14 lacks std::source_location.)
struct Place {
  const char* file;
  int line;
  static constexpr Place here(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
};

// Requires a condition that must hold for every input. Throws an exception that no target catches.
void require(bool holds, Place where = Place::here());

// Requires an error that input files or texts may cause: one line, with an allowed number.
void requireOwn(const Error& error, std::initializer_list<ErrorId> allowed,
                Place where = Place::here());

// Whether `read` accepts the input. Errors in `allowed` mean no; any other exception is a fault.
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

// Cuts `rest` after the first `end` and returns the text before it; without an `end`, returns all.
std::string_view cut(std::string_view& rest, char end);

// Writes a file in this process's own folder and returns its path. The folder is deleted at exit.
std::string scratchFile(const std::string& name, std::string_view content);

}  // namespace grisaille::fuzz
