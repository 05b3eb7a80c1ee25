// SPDX-License-Identifier: MIT
// The folder of the libraries that the program loads at run time.
#pragma once

#include <filesystem>

namespace grisaille {

// lib/grisaille beside the program's folder; "" if the system does not report that folder.
inline std::filesystem::path libraryFolder() {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) return {};
  return (program.parent_path() / ".." / "lib" / "grisaille").lexically_normal();
}

}  // namespace grisaille
