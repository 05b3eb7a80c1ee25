// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>

#include "core/base/library_folder.h"
#include "core/effect/registry.h"

namespace grisaille::effect {

std::vector<SearchPath> searchPaths(std::span<const std::string> extra) {
  std::vector<SearchPath> paths;
  if (const auto folder = libraryFolder(); !folder.empty()) {
    paths.push_back({folder / "effects", false, Origin::kOwn});
  }
  if (const char* variable = std::getenv("GRISAILLE_EFFECT_PATH")) {
    std::string_view rest = variable;
    while (!rest.empty()) {
      const size_t end = std::min(rest.find(':'), rest.size());
      if (end > 0) paths.push_back({std::string(rest.substr(0, end)), true, Origin::kForeign});
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  for (const std::string& folder : extra) paths.push_back({folder, true, Origin::kForeign});
  return paths;
}

}  // namespace grisaille::effect
