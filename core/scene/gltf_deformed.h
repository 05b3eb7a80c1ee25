// SPDX-License-Identifier: MIT
// Loads what moves: skinned and morphed meshes, and animations.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/scene/gltf_mesh.h"
#include "core/scene/gltf_nodes.h"
#include "core/scene/rig.h"

namespace grisaille::scene {

struct DeformedMesh {
  int index = -1;  // into Rig::deformed
  bool skinned = false;
  std::vector<uint32_t> primitives;  // indices into scene.primitives
};

struct InfluenceSet;

class DeformedLoader {
 public:
  // The arguments must outlive the loader. It sets the weights of the tree's nodes.
  DeformedLoader(const tinygltf::Model& model, NodeTree& tree, MeshLoader& meshes, Scene& scene,
                 Rig& rig);

  // Whether a skin or morph targets move the mesh of a node.
  bool moves(const PlacedMesh& placed) const;

  // Loads the mesh of a node, with vertices of its own, into scene and rig. Throws kSceneInvalid,
  // kSceneTooLarge.
  DeformedMesh load(const PlacedMesh& placed);

 private:
  int skinOf(const PlacedMesh& placed);
  uint32_t verticesOf(const tinygltf::Primitive& primitive, bool skinned);
  void addInfluences(const std::vector<InfluenceSet>& sets, DeformedVertices& to);
  void addTargets(const tinygltf::Primitive& primitive, DeformedVertices& to);
  std::vector<double> weightsOf(const PlacedMesh& placed) const;
  void keepNormals(const std::vector<DeformedRun>& runs);

  const tinygltf::Model& model_;
  NodeTree& tree_;
  std::vector<bool> reached_;  // nodes that have a place in the tree
  MeshLoader& meshes_;
  Scene& scene_;
  Rig& rig_;
  std::map<int, int> skins_;                       // index in the file to index in the rig
  std::map<std::vector<int>, uint32_t> vertices_;  // by accessors
  uint64_t morphed_ = 0, influences_ = 0;          // totals
};

// Reads all animations in the file's order. Leaves out channels without a node and channels that
// cannot move theirs, with a note. `rig`: its nodes; the function sets no other part. Throws
// kSceneInvalid, kSceneTooLarge.
std::vector<Animation> readAnimations(const tinygltf::Model& model, const Rig& rig,
                                      std::vector<std::string>& notes);

// The number of morph targets of a mesh.
size_t targetCount(const tinygltf::Model& model, int mesh);

}  // namespace grisaille::scene
