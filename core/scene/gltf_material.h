// SPDX-License-Identifier: MIT
// Loads materials and their base colour textures from glTF.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace grisaille::scene {

// The texture coordinates of a material's base colour texture. The mesh loader applies
// KHR_texture_transform to the coordinates once, at load.
struct TexCoordUse {
  int set = 0;                               // n of TEXCOORD_n
  glm::dmat3x2 transform = glm::dmat3x2(1);  // uv = transform * (u, v, 1)

  bool operator==(const TexCoordUse&) const = default;
};

// Appends one material per glTF material to scene.materials, in the file's order, and the textures
// that they use to scene.textures. `path`: the glTF file. Returns one TexCoordUse per material.
// Adds a note for each image that cannot be read. Throws kSceneInvalid, kSceneTooLarge.
std::vector<TexCoordUse> loadMaterials(const std::string& path, const tinygltf::Model& model,
                                       Scene& scene);

}  // namespace grisaille::scene
