// SPDX-License-Identifier: MIT
// Loads glTF meshes of any mode and layout as indexed triangles with normals.
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
  // `uses`: one per material of the scene. `model` and `scene` must outlive the loader.
  MeshLoader(const tinygltf::Model& model, std::vector<TexCoordUse> uses, Scene& scene);

  // Returns the indices into scene.primitives of a mesh's triangles. The first call for a mesh
  // loads it. Skips points, lines and primitives without positions. Throws kSceneInvalid,
  // kSceneTooLarge.
  const std::vector<uint32_t>& primitivesOf(int mesh);

 private:
  // A run of the scene's vertex arrays. Primitives with the same accessors share a run.
  struct VertexRun {
    uint32_t first = 0;
    bool lacksNormals = false;  // at least one normal has length 0
  };
  struct VertexKey {
    int positions = -1, normals = -1, texCoords = -1;
    uint32_t material = 0;  // material index + 1 if it has a texture transform, else 0
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
