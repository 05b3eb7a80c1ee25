// SPDX-License-Identifier: MIT
#include <tiny_gltf.h>

#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <set>

#include "core/base/error.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_material.h"
#include "core/scene/gltf_mesh.h"
#include "core/scene/scene.h"

namespace grisaille::scene {
namespace {

using Progress = std::function<void(double)>;

constexpr double kParsedShare = 0.5;  // rough fraction of the load time that parsing takes

[[noreturn]] void refuseNode(int node, std::string_view why) {
  throw Error(ErrorId::kSceneInvalid, "node {} {}", node, why);
}

glm::dvec3 vec3Of(const std::vector<double>& values, const glm::dvec3& missing, int node) {
  if (values.empty()) return missing;
  if (values.size() != 3) refuseNode(node, "has a transform of the wrong length");
  return {values[0], values[1], values[2]};
}

glm::dmat4 transformOf(const tinygltf::Node& node, int index) {
  glm::dmat4 matrix(1);
  if (!node.matrix.empty()) {
    if (node.matrix.size() != 16) refuseNode(index, "has a matrix of the wrong length");
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
  } else {
    const glm::dvec3 translation = vec3Of(node.translation, glm::dvec3(0), index);
    const glm::dvec3 scale = vec3Of(node.scale, glm::dvec3(1), index);
    glm::dquat rotation(1, 0, 0, 0);
    if (!node.rotation.empty()) {
      if (node.rotation.size() != 4) refuseNode(index, "has a rotation of the wrong length");
      rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      if (!(glm::length(rotation) > 1e-9)) refuseNode(index, "has a rotation without length");
      rotation = glm::normalize(rotation);
    }
    const glm::dmat3 turn = glm::mat3_cast(rotation);
    for (int i = 0; i < 3; ++i) matrix[i] = glm::dvec4(turn[i] * scale[i], 0);
    matrix[3] = glm::dvec4(translation, 1);
  }
  for (int i = 0; i < 4; ++i) {
    if (!(std::abs(matrix[i].w - (i == 3 ? 1 : 0)) < 1e-6)) {
      refuseNode(index, "has a matrix that is not affine");
    }
    matrix[i].w = i == 3 ? 1 : 0;
  }
  return matrix;
}

// Returns the root nodes: of the default scene, else of the first scene, else all nodes without a
// parent.
std::vector<int> rootsOf(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    const int index = model.defaultScene == -1 ? 0 : model.defaultScene;
    if (index < 0 || static_cast<size_t>(index) >= model.scenes.size()) {
      throw Error(ErrorId::kSceneInvalid, "scene {} does not exist", index);
    }
    return model.scenes[static_cast<size_t>(index)].nodes;
  }
  std::vector<bool> held(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<size_t>(child) < held.size()) {
        held[static_cast<size_t>(child)] = true;
      }
    }
  }
  std::vector<int> roots;
  for (size_t i = 0; i < held.size(); ++i) {
    if (!held[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

struct PlacedMesh {
  int mesh;
  glm::dmat4 worldFromObject;
};

// Visits the nodes depth first, in file order. Uses an explicit stack instead of recursion, because
// a file may nest nodes to any depth.
std::vector<PlacedMesh> placeMeshes(const tinygltf::Model& model) {
  struct Visit {
    int node;
    glm::dmat4 worldFromParent;
  };
  std::vector<PlacedMesh> placed;
  std::vector<Visit> stack;
  const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& worldFromParent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      stack.push_back({*node, worldFromParent});
    }
  };
  std::vector<bool> seen(model.nodes.size(), false);
  push(rootsOf(model), glm::dmat4(1));
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const auto index = static_cast<size_t>(visit.node);
    if (visit.node < 0 || index >= model.nodes.size()) refuseNode(visit.node, "does not exist");
    if (seen[index]) refuseNode(visit.node, "is reached twice: the nodes do not form a tree");
    seen[index] = true;
    const tinygltf::Node& node = model.nodes[index];
    const glm::dmat4 world = visit.worldFromParent * transformOf(node, visit.node);
    for (int i = 0; i < 16; ++i) {
      if (!std::isfinite(world[i / 4][i % 4]))
        refuseNode(visit.node, "has a world transform that is not finite");
    }
    if (node.mesh != -1) placed.push_back({node.mesh, world});
    push(node.children, world);
  }
  return placed;
}

void addInstances(const tinygltf::Model& model, MeshLoader& meshes, Scene& scene,
                  const Progress& progress) {
  const std::vector<PlacedMesh> placed = placeMeshes(model);
  // Meshes that a node uses, in file order.
  std::set<int> shown;
  for (const PlacedMesh& one : placed) shown.insert(one.mesh);
  double done = 0;
  for (const int mesh : shown) {
    meshes.primitivesOf(mesh);
    progress(kParsedShare + (1 - kParsedShare) * ++done / static_cast<double>(shown.size()));
  }
  for (const PlacedMesh& one : placed) {
    for (const uint32_t primitive : meshes.primitivesOf(one.mesh)) {
      if (scene.instances.size() >= kMaxInstances) {
        throw Error(ErrorId::kSceneTooLarge, "more than {} instances", kMaxInstances);
      }
      scene.instances.push_back({.primitive = primitive, .worldFromObject = one.worldFromObject});
    }
  }
}

Scene load(const std::string& path, const Progress& progress) {
  tinygltf::Model model;
  readModel(path, model);
  progress(kParsedShare);
  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  MeshLoader meshes(model, loadMaterials(path, model, scene), scene);
  addInstances(model, meshes, scene, progress);
  if (scene.instances.empty()) throw Error(ErrorId::kSceneEmpty, "the scene has no triangles");
  // Vertices without a triangle may still have a normal of length 0.
  for (glm::vec3& normal : scene.normals) {
    if (normal == glm::vec3(0)) normal = glm::vec3(0, 1, 0);
  }
  computeBounds(scene);
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(scene.bounds.min[i]) || !std::isfinite(scene.bounds.max[i])) {
      throw Error(ErrorId::kSceneInvalid, "the scene's bounds are not finite");
    }
  }
  return scene;
}

}  // namespace

Scene loadGltf(const std::string& path, const Progress& progress) {
  try {
    return load(
        path, progress ? progress : [](double) {});
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", path, error.detail());
  } catch (const std::bad_alloc&) {
    throw Error(ErrorId::kSceneTooLarge, "{}: the scene does not fit in memory", path);
  }
}

}  // namespace grisaille::scene
