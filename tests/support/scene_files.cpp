// SPDX-License-Identifier: MIT
#include "tests/support/scene_files.h"

#include <algorithm>
#include <filesystem>

namespace grisaille::tests {

std::vector<std::string> sceneFilesBelow(const std::vector<std::string>& folders) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    std::error_code missing;
    for (const auto& entry : fs::recursive_directory_iterator(folder, missing)) {
      const std::string ending = entry.path().extension();
      if (ending == ".glb" || ending == ".gltf") files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace grisaille::tests
