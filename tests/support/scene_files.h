// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace grisaille::tests {

// The .glb and .gltf files in these folders and below, sorted; none of a folder that is missing.
std::vector<std::string> sceneFilesBelow(const std::vector<std::string>& folders);

}  // namespace grisaille::tests
