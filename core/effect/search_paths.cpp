// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>

#include "core/effect/registry.h"

namespace grisaille::effect {

std::vector<SearchPath> searchPaths(std::span<const std::string> extra) {
  std::vector<SearchPath> paths;
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (!failed) {
    const auto beside = program.parent_path() / ".." / "lib" / "grisaille" / "effects";
    paths.push_back({beside.lexically_normal().string(), false});
  }
  if (const char* variable = std::getenv("GRISAILLE_EFFECT_PATH")) {
    std::string_view rest = variable;
    while (!rest.empty()) {
      const size_t end = std::min(rest.find(':'), rest.size());
      if (end > 0) paths.push_back({std::string(rest.substr(0, end)), true});
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  for (const std::string& folder : extra) paths.push_back({folder, true});
  return paths;
}

}  // namespace grisaille::effect
