// SPDX-License-Identifier: MIT
#include "app/settings/load_effects.h"

#include <filesystem>

namespace grisaille::app {

std::unique_ptr<effect::Registry> loadEffects(const std::vector<std::string>& pluginPaths) {
  auto registry = std::make_unique<effect::Registry>();
  for (const effect::SearchPath& path : effect::searchPaths(pluginPaths)) {
    if (path.required || std::filesystem::is_directory(path.folder)) {
      registry->scan(path.folder, path.origin);
    }
  }
  return registry;
}

}  // namespace grisaille::app
