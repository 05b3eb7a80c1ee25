// SPDX-License-Identifier: MIT
// Where what the program loads while it runs lies.
#pragma once

#include <filesystem>

namespace grisaille {

// lib/grisaille beside the folder of the program; "" where the system does not tell it.
inline std::filesystem::path libraryFolder() {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) return {};
  return (program.parent_path() / ".." / "lib" / "grisaille").lexically_normal();
}

}  // namespace grisaille
