// SPDX-License-Identifier: MIT
#include "core/scene/gltf_deformed.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

namespace grisaille::scene {

// The accessors of JOINTS_n and WEIGHTS_n, four influences each.
struct InfluenceSet {
  std::string joints, weights;  // names of the attributes
  int jointAccessor = -1, weightAccessor = -1;
};

namespace {

std::vector<InfluenceSet> influenceSets(const tinygltf::Primitive& primitive) {
  std::vector<InfluenceSet> sets;
  for (size_t n = 0;; ++n) {
    InfluenceSet set{.joints = fmt::format("JOINTS_{}", n),
                     .weights = fmt::format("WEIGHTS_{}", n)};
    set.jointAccessor = attributeOf(primitive, set.joints);
    set.weightAccessor = attributeOf(primitive, set.weights);
    if (set.jointAccessor < 0 && set.weightAccessor < 0) return sets;
    if (set.jointAccessor < 0 || set.weightAccessor < 0) {
      throw Error(ErrorId::kSceneInvalid, "attributes: {} without {}",
                  set.jointAccessor < 0 ? set.weights : set.joints,
                  set.jointAccessor < 0 ? set.joints : set.weights);
    }
    sets.push_back(set);
  }
}

int targetAttribute(const std::map<std::string, int>& target, const char* name) {
  const auto found = target.find(name);
  return found == target.end() ? -1 : found->second;
}

void requireCount(uint64_t count, uint64_t vertices) {
  if (count == vertices) return;
  throw Error(ErrorId::kSceneInvalid, "{} elements for {} vertices", count, vertices);
}

}  // namespace

DeformedLoader::DeformedLoader(const tinygltf::Model& model, NodeTree& tree, MeshLoader& meshes,
                               Scene& scene, Rig& rig)
    : model_(model),
      tree_(tree),
      reached_(model.nodes.size(), false),
      meshes_(meshes),
      scene_(scene),
      rig_(rig) {
  for (const uint32_t node : tree.order) reached_[node] = true;
}

bool DeformedLoader::moves(const PlacedMesh& placed) const {
  if (placed.mesh < 0 || static_cast<size_t>(placed.mesh) >= model_.meshes.size()) return false;
  const bool hasSkin = model_.nodes[placed.node].skin != -1;
  const auto& primitives = model_.meshes[static_cast<size_t>(placed.mesh)].primitives;
  return std::ranges::any_of(primitives, [&](const tinygltf::Primitive& primitive) {
    return !primitive.targets.empty() || (hasSkin && attributeOf(primitive, "JOINTS_0") >= 0);
  });
}

DeformedMesh DeformedLoader::load(const PlacedMesh& placed) {
  const tinygltf::Mesh& mesh = model_.meshes[static_cast<size_t>(placed.mesh)];
  const bool joined = std::ranges::any_of(mesh.primitives, [](const auto& primitive) {
    return attributeOf(primitive, "JOINTS_0") >= 0;
  });
  DeformedMesh result{.index = static_cast<int>(rig_.deformed.size()), .primitives = {}};
  DeformedNode node{.node = placed.node, .runs = {}};
  if (joined && model_.nodes[placed.node].skin != -1) {
    node.skin = inPlace(fmt::format("nodes[{}].skin", placed.node), [&] { return skinOf(placed); });
    result.skinned = true;
  }
  tree_.nodes[placed.node].weights = weightsOf(placed);
  MeshLoader::Runs runs;
  for (size_t i = 0; i < mesh.primitives.size(); ++i) {
    const tinygltf::Primitive& primitive = mesh.primitives[i];
    inPlace(fmt::format("meshes[{}].primitives[{}]", placed.mesh, i), [&] {
      if (primitive.mode < TINYGLTF_MODE_TRIANGLES || attributeOf(primitive, "POSITION") < 0)
        return;
      const uint32_t vertices = verticesOf(primitive, result.skinned);
      auto loaded = meshes_.loadPrimitive(primitive, static_cast<int>(vertices), runs);
      if (!loaded) return;
      result.primitives.push_back(loaded->primitive);
      if (result.skinned) {
        const size_t joints = rig_.skins[static_cast<size_t>(node.skin)].joints.size();
        for (const Influence& influence : rig_.vertices[vertices].influences) {
          if (influence.joint < joints) continue;
          throw Error(ErrorId::kSceneInvalid,
                      "attributes.JOINTS_0: joint {} of skins[{}], which has {}", influence.joint,
                      model_.nodes[placed.node].skin, joints);
        }
      }
      if (!loaded->newVertices) return;
      node.runs.push_back({.vertices = vertices,
                           .firstVertex = loaded->firstVertex,
                           .vertexCount = loaded->vertexCount,
                           .sources = std::move(loaded->sources)});
    });
  }
  keepNormals(node.runs);
  rig_.deformed.push_back(std::move(node));
  return result;
}

// The mesh loader has made the normals unit, and replaced those of length 0.
void DeformedLoader::keepNormals(const std::vector<DeformedRun>& runs) {
  for (const DeformedRun& run : runs) {
    std::vector<glm::vec3>& normals = rig_.vertices[run.vertices].normals;
    if (!run.sources.empty() || !normals.empty()) continue;
    const auto first = scene_.normals.begin() + static_cast<std::ptrdiff_t>(run.firstVertex);
    normals.assign(first, first + static_cast<std::ptrdiff_t>(run.vertexCount));
  }
}

int DeformedLoader::skinOf(const PlacedMesh& placed) {
  const int index = model_.nodes[placed.node].skin;
  if (index < 0 || static_cast<size_t>(index) >= model_.skins.size()) {
    throw Error(ErrorId::kSceneInvalid, "skin {} does not exist", index);
  }
  const auto [found, isNew] = skins_.try_emplace(index, static_cast<int>(rig_.skins.size()));
  if (!isNew) return found->second;
  const tinygltf::Skin& from = model_.skins[static_cast<size_t>(index)];
  RigSkin skin;
  for (size_t i = 0; i < from.joints.size(); ++i) {
    const int joint = from.joints[i];
    if (joint < 0 || static_cast<size_t>(joint) >= reached_.size() ||
        !reached_[static_cast<size_t>(joint)]) {
      throw Error(ErrorId::kSceneInvalid, "skins[{}].joints[{}]: node {} is not in a tree of nodes",
                  index, i, joint);
    }
    skin.joints.push_back(static_cast<uint32_t>(joint));
  }
  skin.inverseBinds.resize(skin.joints.size(), glm::dmat4(1));
  if (from.inverseBindMatrices != -1) {
    inPlace(fmt::format("skins[{}].inverseBindMatrices", index), [&] {
      const uint64_t count = accessorCount(model_, from.inverseBindMatrices);
      if (count < skin.joints.size()) {
        throw Error(ErrorId::kSceneInvalid, "{} matrices for {} joints", count, skin.joints.size());
      }
      const auto matrices = readMat4(model_, from.inverseBindMatrices);
      std::copy_n(matrices.begin(), skin.joints.size(), skin.inverseBinds.begin());
    });
  }
  rig_.skins.push_back(std::move(skin));
  return found->second;
}

std::vector<double> DeformedLoader::weightsOf(const PlacedMesh& placed) const {
  const size_t count = targetCount(model_, placed.mesh);
  const std::vector<double>& own = model_.nodes[placed.node].weights;
  const std::vector<double>& shared = model_.meshes[static_cast<size_t>(placed.mesh)].weights;
  std::vector<double> weights = own.empty() ? shared : own;
  if (!weights.empty() && weights.size() != count) {
    throw Error(ErrorId::kSceneInvalid, "{}[{}].weights: {} weights for {} morph targets",
                own.empty() ? "meshes" : "nodes",
                own.empty() ? static_cast<uint32_t>(placed.mesh) : placed.node, weights.size(),
                count);
  }
  weights.resize(count, 0.0);
  return weights;
}

// Returns the index into Rig::vertices. Primitives with the same accessors share them.
uint32_t DeformedLoader::verticesOf(const tinygltf::Primitive& primitive, bool skinned) {
  const std::vector<InfluenceSet> sets =
      skinned ? influenceSets(primitive) : std::vector<InfluenceSet>();
  std::vector<int> key{attributeOf(primitive, "POSITION"), attributeOf(primitive, "NORMAL")};
  for (const InfluenceSet& set : sets) {
    key.insert(key.end(), {set.jointAccessor, set.weightAccessor});
  }
  key.push_back(-2);  // ends the influences
  for (const auto& target : primitive.targets) {
    key.insert(key.end(), {targetAttribute(target, "POSITION"), targetAttribute(target, "NORMAL")});
  }
  const auto [found, isNew] =
      vertices_.try_emplace(std::move(key), static_cast<uint32_t>(rig_.vertices.size()));
  if (!isNew) return found->second;
  DeformedVertices vertices;
  const int positions = attributeOf(primitive, "POSITION");
  if (accessorCount(model_, positions) > kMaxVertices) {
    throw Error(ErrorId::kSceneTooLarge, "attributes.POSITION: {} vertices; the limit is {}",
                accessorCount(model_, positions), kMaxVertices);
  }
  vertices.positions = inPlace("attributes.POSITION", [&] { return readVec3(model_, positions); });
  if (!sets.empty()) addInfluences(sets, vertices);
  addTargets(primitive, vertices);
  rig_.vertices.push_back(std::move(vertices));
  return found->second;
}

void DeformedLoader::addInfluences(const std::vector<InfluenceSet>& sets, DeformedVertices& to) {
  const size_t count = to.positions.size();
  influences_ += uint64_t{4} * sets.size() * count;
  if (influences_ > kMaxInfluences) {
    throw Error(ErrorId::kSceneTooLarge, "more than {} influences of joints", kMaxInfluences);
  }
  std::vector<std::vector<glm::uvec4>> joints;
  std::vector<std::vector<glm::vec4>> weights;
  for (const InfluenceSet& set : sets) {
    inPlace("attributes." + set.joints, [&] {
      requireCount(accessorCount(model_, set.jointAccessor), count);
      joints.push_back(readJoints(model_, set.jointAccessor));
    });
    inPlace("attributes." + set.weights, [&] {
      requireCount(accessorCount(model_, set.weightAccessor), count);
      weights.push_back(readVec4(model_, set.weightAccessor));
    });
  }
  to.firstInfluence.reserve(count + 1);
  to.firstInfluence.push_back(0);
  for (size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (const auto& set : weights) sum += double{set[i].x} + set[i].y + set[i].z + set[i].w;
    if (std::abs(sum) < 1e-9) {
      // A vertex without weights follows its first joint.
      to.influences.push_back({joints[0][i].x, 1.0f});
    } else {
      for (size_t s = 0; s < sets.size(); ++s) {
        for (int c = 0; c < 4; ++c) {
          const auto weight = static_cast<float>(weights[s][i][c] / sum);
          if (weight != 0) to.influences.push_back({joints[s][i][c], weight});
        }
      }
    }
    to.firstInfluence.push_back(static_cast<uint32_t>(to.influences.size()));
  }
}

void DeformedLoader::addTargets(const tinygltf::Primitive& primitive, DeformedVertices& to) {
  const size_t count = to.positions.size();
  morphed_ += uint64_t{count} * primitive.targets.size();
  if (morphed_ > kMaxMorphed) {
    throw Error(ErrorId::kSceneTooLarge, "the morph targets have more than {} vertices",
                kMaxMorphed);
  }
  for (size_t k = 0; k < primitive.targets.size(); ++k) {
    const auto read = [&](const char* name) {
      const int accessor = targetAttribute(primitive.targets[k], name);
      if (accessor < 0) return std::vector<glm::vec3>();
      return inPlace(fmt::format("targets[{}].{}", k, name), [&] {
        requireCount(accessorCount(model_, accessor), count);
        return readVec3(model_, accessor);
      });
    };
    const std::vector<glm::vec3> positions = read("POSITION"), normals = read("NORMAL");
    MorphTarget target;
    for (size_t i = 0; i < count; ++i) {
      const glm::vec3 position = positions.empty() ? glm::vec3(0) : positions[i];
      const glm::vec3 normal = normals.empty() ? glm::vec3(0) : normals[i];
      if (position == glm::vec3(0) && normal == glm::vec3(0)) continue;
      target.vertices.push_back(static_cast<uint32_t>(i));
      target.positions.push_back(position);
      if (!normals.empty()) target.normals.push_back(normal);
    }
    to.targets.push_back(std::move(target));
  }
}

size_t targetCount(const tinygltf::Model& model, int mesh) {
  if (mesh < 0 || static_cast<size_t>(mesh) >= model.meshes.size()) return 0;
  size_t count = 0;
  for (const tinygltf::Primitive& primitive : model.meshes[static_cast<size_t>(mesh)].primitives) {
    count = std::max(count, primitive.targets.size());
  }
  return count;
}

}  // namespace grisaille::scene
