// SPDX-License-Identifier: MIT
// The binary interface of the installed C headers as a table, and what a change of it means.
#pragma once

#include <string>
#include <vector>

namespace grisaille::tests {

// Includes every installed C header.
inline constexpr const char* kHeaders = "#include <grisaille/host.h>\n";

// Describes every declaration of C headers whose name begins with grisaille_ or GRISAILLE_, one on
// each line as "name: text": constants, values of enums, sizes of structs with the offset, size and
// type of each member, and types of functions. Clang lists the declarations, so that a new one
// cannot be forgotten; the C compiler `cc` lays them out.
// includes: text of a C source, such as "#include <grisaille/host.h>\n"
// options: for both compilers, such as "-I folder"
// Throws std::runtime_error with the compiler's messages.
std::string abiTable(const std::string& includes, const std::string& options);

// How a table differs from an earlier one.
struct AbiChanges {
  std::vector<std::string> breaks;  // programs that were built before no longer fit
  std::vector<std::string> grows;   // programs that were built before still fit
};

// A struct with a member `struct_size` may grow at its end, beyond its earlier size; declarations
// may be added; a constant whose name ends in _COUNT, _MINOR or _VERSION may rise. Everything else
// breaks programs that were built with the earlier headers.
AbiChanges abiChanges(const std::string& before, const std::string& after);

}  // namespace grisaille::tests
