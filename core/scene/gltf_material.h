// SPDX-License-Identifier: MIT
// Materials and their base colour textures out of glTF.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace grisaille::scene {

// How a material's base colour texture is looked up: KHR_texture_transform is applied to the
// coordinates once, at load.
struct TexCoordUse {
  int set = 0;                               // n of TEXCOORD_n
  glm::dmat3x2 transform = glm::dmat3x2(1);  // uv = transform * (u, v, 1)

  bool operator==(const TexCoordUse&) const = default;
};

// Fills scene.materials, one a glTF material and in its order, and scene.textures with what they
// name. Returns each material's use. Throws kSceneInvalid, kSceneImage.
std::vector<TexCoordUse> loadMaterials(const std::string& path, const tinygltf::Model& model,
                                       Scene& scene);

}  // namespace grisaille::scene
