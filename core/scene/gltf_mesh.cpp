// SPDX-License-Identifier: MIT
#include "core/scene/gltf_mesh.h"

#include <tiny_gltf.h>

#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

namespace grisaille::scene {
namespace {

// The length of the result is twice the triangle's area.
glm::dvec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::cross(b - a, c - a);
}

// Converts strips and fans to triangles and keeps their winding.
std::vector<uint32_t> toTriangles(std::vector<uint32_t> indices, int mode) {
  const size_t count = indices.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (count % 3 == 0) return indices;
    throw Error(ErrorId::kSceneInvalid, "{} indices of triangles are not a multiple of 3", count);
  }
  std::vector<uint32_t> result;
  if (count < 3) return result;
  result.reserve((count - 2) * 3);
  for (size_t i = 2; i < count; ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      result.insert(result.end(), {indices[i - 1], indices[i], indices[0]});
    } else if (i % 2 == 0) {
      result.insert(result.end(), {indices[i - 2], indices[i - 1], indices[i]});
    } else {
      result.insert(result.end(), {indices[i - 1], indices[i - 2], indices[i]});
    }
  }
  return result;
}

std::vector<uint32_t> trianglesOf(const tinygltf::Model& model,
                                  const tinygltf::Primitive& primitive, uint64_t vertexCount) {
  std::vector<uint32_t> indices;
  if (primitive.indices >= 0) {
    // A strip of n indices becomes up to 3 n indices.
    if (accessorCount(model, primitive.indices) > kMaxIndices / 3) {
      throw Error(ErrorId::kSceneTooLarge, "{} indices; the limit is {}",
                  accessorCount(model, primitive.indices), kMaxIndices / 3);
    }
    indices = inPlace("indices", [&] { return readIndices(model, primitive.indices); });
  } else {
    indices.resize(vertexCount);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  for (const uint32_t index : indices) {
    if (index >= vertexCount) {
      throw Error(ErrorId::kSceneInvalid,
                  "indices: accessor {}: index {} is out of range for {} vertices",
                  primitive.indices, index, vertexCount);
    }
  }
  return toTriangles(std::move(indices), primitive.mode);
}

}  // namespace

MeshLoader::MeshLoader(const tinygltf::Model& model, std::vector<TexCoordUse> uses, Scene& scene)
    : model_(model), uses_(std::move(uses)), scene_(scene) {}

int attributeOf(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

const std::vector<uint32_t>& MeshLoader::primitivesOf(int mesh) {
  if (mesh < 0 || static_cast<size_t>(mesh) >= model_.meshes.size()) {
    throw Error(ErrorId::kSceneInvalid, "mesh {} does not exist", mesh);
  }
  const auto [found, isNew] = meshes_.try_emplace(mesh);
  if (isNew) {
    const auto& primitives = model_.meshes[static_cast<size_t>(mesh)].primitives;
    for (size_t i = 0; i < primitives.size(); ++i) {
      const auto loaded = inPlace(fmt::format("meshes[{}].primitives[{}]", mesh, i),
                                  [&] { return loadPrimitive(primitives[i], -1, runs_); });
      if (loaded) found->second.push_back(loaded->primitive);
    }
  }
  return found->second;
}

std::optional<LoadedPrimitive> MeshLoader::loadPrimitive(const tinygltf::Primitive& from,
                                                         int deformed, Runs& runs) {
  if (from.mode < TINYGLTF_MODE_POINTS || from.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    throw Error(ErrorId::kSceneInvalid, "mode {} is unknown", from.mode);
  }
  VertexKey key{.positions = attributeOf(from, "POSITION"),
                .normals = attributeOf(from, "NORMAL"),
                .colours = attributeOf(from, "COLOR_0"),
                .deformed = deformed};
  if (from.mode < TINYGLTF_MODE_TRIANGLES || key.positions < 0) return std::nullopt;
  const uint64_t vertexCount = accessorCount(model_, key.positions);
  if (vertexCount == 0) {
    throw Error(ErrorId::kSceneInvalid, "accessor {} is empty", key.positions);
  }
  if (vertexCount > kMaxVertices) {
    throw Error(ErrorId::kSceneTooLarge, "accessor {}: {} vertices; the limit is {}", key.positions,
                vertexCount, kMaxVertices);
  }
  const uint32_t material = materialOf(from);
  const TexCoordUse& use = uses_[material];
  key.texCoords = attributeOf(from, "TEXCOORD_" + std::to_string(use.set));
  if (use.transform != glm::dmat3x2(1)) key.material = material + 1;

  LoadedPrimitive result;
  std::vector<uint32_t> triangles = trianglesOf(model_, from, vertexCount);
  if (triangles.empty()) return std::nullopt;
  if (scene_.indices.size() + triangles.size() > kMaxIndices) {
    throw Error(ErrorId::kSceneTooLarge, "more than {} indices", kMaxIndices);
  }
  VertexRun run;
  if (key.normals < 0) {
    run = appendFlatVertices(key, triangles);
    result.sources = triangles;
    std::iota(triangles.begin(), triangles.end(), 0u);
  } else {
    const auto [found, isNew] = runs.try_emplace(key);
    if (isNew) appendVertices(key, found->second);
    run = found->second;
    result.newVertices = isNew;
  }
  const auto first = static_cast<uint32_t>(scene_.indices.size());
  for (const uint32_t index : triangles) scene_.indices.push_back(run.first + index);
  if (run.lacksNormals) repairNormals(std::span(scene_.indices).subspan(first));
  result.primitive = static_cast<uint32_t>(scene_.primitives.size());
  result.firstVertex = run.first;
  result.vertexCount = run.count;
  scene_.primitives.push_back({.firstIndex = first,
                               .indexCount = static_cast<uint32_t>(triangles.size()),
                               .material = material,
                               .coloured = key.colours >= 0});
  return result;
}

uint32_t MeshLoader::materialOf(const tinygltf::Primitive& from) {
  if (from.material >= 0 && static_cast<size_t>(from.material) < model_.materials.size()) {
    return static_cast<uint32_t>(from.material);
  }
  if (from.material != -1) {
    throw Error(ErrorId::kSceneInvalid, "material {} does not exist", from.material);
  }
  if (defaultMaterial_ < 0) {
    defaultMaterial_ = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back({.name = "default"});
    uses_.emplace_back();
  }
  return static_cast<uint32_t>(defaultMaterial_);
}

void MeshLoader::appendVertices(const VertexKey& key, VertexRun& run) {
  const uint64_t count = accessorCount(model_, key.positions);
  if (scene_.positions.size() + count > kMaxVertices) {
    throw Error(ErrorId::kSceneTooLarge, "more than {} vertices", kMaxVertices);
  }
  if (accessorCount(model_, key.normals) != count) {
    throw Error(ErrorId::kSceneInvalid, "accessor {}: {} normals for {} positions", key.normals,
                accessorCount(model_, key.normals), count);
  }
  run = {.first = static_cast<uint32_t>(scene_.positions.size()),
         .count = static_cast<uint32_t>(count)};
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(scene_.positions,
         inPlace("attributes.POSITION", [&] { return readVec3(model_, key.positions); }));
  std::vector<glm::vec3> normals =
      inPlace("attributes.NORMAL", [&] { return readVec3(model_, key.normals); });
  for (glm::vec3& normal : normals) {
    const double length = glm::length(glm::dvec3(normal));
    normal = length > 1e-12 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0);
    run.lacksNormals = run.lacksNormals || length <= 1e-12;
  }
  append(scene_.normals, normals);
  append(scene_.texCoords, texCoordsOf(key, count));
  if (key.colours < 0 && scene_.colours.empty()) return;
  scene_.colours.resize(run.first, glm::vec4(1));
  append(scene_.colours, coloursOf(key, count));
}

// glTF requires flat shading for primitives without normals: every triangle gets its own vertices.
MeshLoader::VertexRun MeshLoader::appendFlatVertices(const VertexKey& key,
                                                     std::span<const uint32_t> triangles) {
  if (scene_.positions.size() + triangles.size() > kMaxVertices) {
    throw Error(ErrorId::kSceneTooLarge, "more than {} vertices", kMaxVertices);
  }
  const VertexRun run{.first = static_cast<uint32_t>(scene_.positions.size()),
                      .count = static_cast<uint32_t>(triangles.size())};
  const std::vector<glm::vec3> positions =
      inPlace("attributes.POSITION", [&] { return readVec3(model_, key.positions); });
  for (size_t i = 0; i < triangles.size(); i += 3) {
    const glm::vec3 p[] = {positions[triangles[i]], positions[triangles[i + 1]],
                           positions[triangles[i + 2]]};
    const glm::dvec3 normal = faceNormal(p[0], p[1], p[2]);
    const double length = glm::length(normal);
    scene_.positions.insert(scene_.positions.end(), p, p + 3);
    // A triangle without area is never visible: any normal will do.
    scene_.normals.insert(scene_.normals.end(), 3,
                          length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 1, 0));
  }
  const std::vector<glm::vec2> texCoords = texCoordsOf(key, positions.size());
  for (const uint32_t index : triangles) scene_.texCoords.push_back(texCoords[index]);
  if (key.colours < 0 && scene_.colours.empty()) return run;
  const std::vector<glm::vec4> colours = coloursOf(key, positions.size());
  scene_.colours.resize(run.first, glm::vec4(1));
  for (const uint32_t index : triangles) scene_.colours.push_back(colours[index]);
  return run;
}

std::vector<glm::vec2> MeshLoader::texCoordsOf(const VertexKey& key, size_t count) const {
  if (key.texCoords < 0) return std::vector<glm::vec2>(count, glm::vec2(0));
  if (accessorCount(model_, key.texCoords) != count) {
    throw Error(ErrorId::kSceneInvalid, "accessor {}: {} texture coordinates for {} positions",
                key.texCoords, accessorCount(model_, key.texCoords), count);
  }
  std::vector<glm::vec2> texCoords = readVec2(model_, key.texCoords);
  if (key.material == 0) return texCoords;
  const glm::dmat3x2& transform = uses_[key.material - 1].transform;
  for (glm::vec2& uv : texCoords) {
    uv = glm::vec2(transform * glm::dvec3(uv, 1));
    if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
    throw Error(ErrorId::kSceneInvalid,
                "accessor {}: KHR_texture_transform makes coordinates that are not finite",
                key.texCoords);
  }
  return texCoords;
}

std::vector<glm::vec4> MeshLoader::coloursOf(const VertexKey& key, size_t count) const {
  if (key.colours < 0) return std::vector<glm::vec4>(count, glm::vec4(1));
  return inPlace("attributes.COLOR_0", [&] {
    if (accessorCount(model_, key.colours) != count) {
      throw Error(ErrorId::kSceneInvalid, "{} colours for {} positions",
                  accessorCount(model_, key.colours), count);
    }
    if (!isVec3(model_, key.colours)) return readVec4(model_, key.colours);
    std::vector<glm::vec4> colours;
    for (const glm::vec3& rgb : readVec3(model_, key.colours)) colours.emplace_back(rgb, 1);
    return colours;
  });
}

// Replaces normals of length 0 by the area-weighted mean normal of the faces in `indices` that use
// the vertex.
void MeshLoader::repairNormals(std::span<const uint32_t> indices) {
  std::map<uint32_t, glm::dvec3> sums;
  for (size_t i = 0; i < indices.size(); i += 3) {
    const auto p = [&](size_t k) { return glm::dvec3(scene_.positions[indices[i + k]]); };
    for (size_t k = 0; k < 3; ++k) {
      if (scene_.normals[indices[i + k]] == glm::vec3(0)) {
        sums[indices[i + k]] += faceNormal(p(0), p(1), p(2));
      }
    }
  }
  for (const auto& [vertex, sum] : sums) {
    const double length = glm::length(sum);
    scene_.normals[vertex] = length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
  }
}

}  // namespace grisaille::scene
