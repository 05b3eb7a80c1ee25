// SPDX-License-Identifier: MIT
// Loads glTF meshes of any mode and layout as indexed triangles with normals.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/gltf_material.h"
#include "core/scene/scene.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace grisaille::scene {

// A run of the scene's vertex arrays, used by one primitive.
struct LoadedPrimitive {
  uint32_t primitive = 0;  // index into scene.primitives
  uint32_t firstVertex = 0;
  uint32_t vertexCount = 0;
  bool newVertices = true;  // false: an earlier primitive has the same run
  // Primitives without normals have three vertices for each triangle: their indices in the file's
  // primitive. Empty: the same.
  std::vector<uint32_t> sources;
};

class MeshLoader {
 public:
  // `uses`: one per material of the scene. `model` and `scene` must outlive the loader.
  MeshLoader(const tinygltf::Model& model, std::vector<TexCoordUse> uses, Scene& scene);

  // Returns the indices into scene.primitives of a mesh's triangles. The first call for a mesh
  // loads it. Skips points, lines and primitives without positions. Throws kSceneInvalid,
  // kSceneTooLarge.
  const std::vector<uint32_t>& primitivesOf(int mesh);

  // A run of the scene's vertex arrays. Primitives with the same accessors share a run.
  struct VertexRun {
    uint32_t first = 0;
    uint32_t count = 0;
    bool lacksNormals = false;  // at least one normal has length 0
  };
  struct VertexKey {
    int positions = -1, normals = -1, texCoords = -1, colours = -1;
    uint32_t material = 0;  // material index + 1 if it has a texture transform, else 0
    int deformed = -1;      // which skin weights and morph targets; -1: none
    auto operator<=>(const VertexKey&) const = default;
  };
  using Runs = std::map<VertexKey, VertexRun>;

  // Loads one primitive with vertices that no primitive outside `runs` shares. None if it has no
  // triangles. Throws as primitivesOf().
  std::optional<LoadedPrimitive> loadPrimitive(const tinygltf::Primitive& from, int deformed,
                                               Runs& runs);

 private:
  uint32_t materialOf(const tinygltf::Primitive& from);
  void appendVertices(const VertexKey& key, VertexRun& run);
  VertexRun appendFlatVertices(const VertexKey& key, std::span<const uint32_t> triangles);
  std::vector<glm::vec2> texCoordsOf(const VertexKey& key, size_t count) const;
  std::vector<glm::vec4> coloursOf(const VertexKey& key, size_t count) const;
  void repairNormals(std::span<const uint32_t> indices);

  const tinygltf::Model& model_;
  std::vector<TexCoordUse> uses_;
  Scene& scene_;
  std::map<int, std::vector<uint32_t>> meshes_;
  Runs runs_;
  int defaultMaterial_ = -1;
};

// The accessor of an attribute, -1: none.
int attributeOf(const tinygltf::Primitive& primitive, const std::string& name);

}  // namespace grisaille::scene
