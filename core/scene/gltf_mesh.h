// SPDX-License-Identifier: MIT
// Meshes out of glTF: any mode and layout to indexed triangles with normals.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/scene/gltf_material.h"
#include "core/scene/scene.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace grisaille::scene {

class MeshLoader {
 public:
  // `uses`: one a material of the scene.
  MeshLoader(const tinygltf::Model& model, std::vector<TexCoordUse> uses, Scene& scene);

  // Indices into scene.primitives of a mesh's triangles; loaded at the first call. Points, lines
  // and primitives without positions are left out. Throws kSceneInvalid, kSceneTooLarge.
  const std::vector<uint32_t>& primitivesOf(int mesh);

 private:
  // A run of the scene's vertex arrays. Primitives of one set of accessors share it.
  struct VertexRun {
    uint32_t first = 0;
    bool lacksNormals = false;  // some have no length
  };
  struct VertexKey {
    int positions = -1, normals = -1, texCoords = -1;
    uint32_t material = 0;  // its texture transform, where it has one
    auto operator<=>(const VertexKey&) const = default;
  };

  void loadPrimitive(const tinygltf::Primitive& from, std::vector<uint32_t>& result);
  uint32_t materialOf(const tinygltf::Primitive& from);
  VertexRun vertices(const VertexKey& key);
  VertexRun flatVertices(const VertexKey& key, std::vector<uint32_t>& triangles);
  void appendTexCoords(const VertexKey& key, size_t count);
  void repairNormals(std::span<const uint32_t> indices);

  const tinygltf::Model& model_;
  std::vector<TexCoordUse> uses_;
  Scene& scene_;
  std::map<int, std::vector<uint32_t>> meshes_;
  std::map<VertexKey, VertexRun> runs_;
  int defaultMaterial_ = -1;
};

}  // namespace grisaille::scene
