// SPDX-License-Identifier: MIT
// grisaille_abi_table [--break]: brings docs/abi.txt up to date with the installed headers. Refuses
// changes that break programs built with the earlier headers, unless --break is given.
#include <fmt/format.h>

#include <exception>
#include <fstream>
#include <string_view>

#include "tests/abi/abi.h"
#include "tests/program/run.h"

int main(int count, char** arguments) {
  using namespace grisaille::tests;
  const bool mayBreak = count == 2 && std::string_view(arguments[1]) == "--break";
  if (count > 1 && !mayBreak) {
    fmt::print(stderr, "usage: grisaille_abi_table [--break]\n");
    return 2;
  }
  try {
    const std::string before = readFile(ABI_TABLE);
    const std::string after = abiTable(kHeaders, ABI_OPTIONS);
    const AbiChanges changes = abiChanges(before, after);
    for (const std::string& change : changes.grows) fmt::print("grows: {}\n", change);
    for (const std::string& change : changes.breaks) fmt::print("breaks: {}\n", change);
    if (!changes.breaks.empty() && !mayBreak) {
      fmt::print(
          stderr,
          "grisaille_abi_table: these changes break programs that exist. Undo them; or raise "
          "GRISAILLE_ABI_MAJOR and the SOVERSION of libgrisaille, and pass --break.\n");
      return 1;
    }
    std::ofstream(ABI_TABLE) << after;
  } catch (const std::exception& error) {
    fmt::print(stderr, "grisaille_abi_table: {}\n", error.what());
    return 1;
  }
}
