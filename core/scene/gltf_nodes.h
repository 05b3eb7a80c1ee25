// SPDX-License-Identifier: MIT
// Reads the nodes of a glTF file: their tree, and the meshes that the scene shows.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/scene/rig.h"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace grisaille::scene {

struct PlacedMesh {
  int mesh = -1;
  uint32_t node = 0;
  glm::dmat4 worldFromNode = glm::dmat4(1);
};

struct NodeTree {
  std::vector<RigNode> nodes;      // all of the file, without weights
  std::vector<uint32_t> order;     // those of the scene and of its skins, parents first
  std::vector<PlacedMesh> placed;  // in depth-first order
};

// Throws kSceneInvalid.
NodeTree readNodes(const tinygltf::Model& model);

// The transforms of EXT_mesh_gpu_instancing: node from instance. One identity if the node does not
// use the extension. Throws kSceneInvalid, kSceneTooLarge.
std::vector<glm::dmat4> readInstancing(const tinygltf::Model& model, uint32_t node);

}  // namespace grisaille::scene
