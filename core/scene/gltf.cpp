// SPDX-License-Identifier: MIT
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/base/error.h"
#include "core/scene/gltf_deformed.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_material.h"
#include "core/scene/gltf_mesh.h"
#include "core/scene/gltf_nodes.h"
#include "core/scene/rig.h"
#include "core/scene/scene.h"

namespace grisaille::scene {
namespace {

using Progress = std::function<void(double)>;

constexpr double kParsedShare = 0.5;  // rough fraction of the load time that parsing takes

// Adds an instance of each primitive for each transform of the placed mesh.
void place(const PlacedMesh& placed, const std::vector<uint32_t>& primitives,
           const std::vector<glm::dmat4>& transforms, int skinned, Scene& scene, Rig& rig) {
  for (const glm::dmat4& transform : transforms) {
    for (const uint32_t primitive : primitives) {
      if (scene.instances.size() >= kMaxInstances) {
        throw Error(ErrorId::kSceneTooLarge, "more than {} instances", kMaxInstances);
      }
      const glm::dmat4 world = placed.worldFromNode * transform;
      for (int i = 0; i < 16; ++i) {
        if (std::isfinite(world[i / 4][i % 4])) continue;
        throw Error(ErrorId::kSceneInvalid, "nodes[{}]: an instance's transform is not finite",
                    placed.node);
      }
      scene.instances.push_back({.primitive = primitive, .worldFromObject = world});
      rig.instances.push_back(
          {.node = placed.node, .deformed = skinned, .nodeFromObject = transform});
    }
  }
}

void addInstances(const tinygltf::Model& model, NodeTree& tree, MeshLoader& meshes, Scene& scene,
                  Rig& rig, const Progress& progress) {
  DeformedLoader deformed(model, tree, meshes, scene, rig);
  // Load meshes that a node uses in file order.
  std::set<int> shown;
  for (const PlacedMesh& placed : tree.placed) {
    if (!deformed.moves(placed)) shown.insert(placed.mesh);
  }
  double done = 0;
  for (const int mesh : shown) {
    meshes.primitivesOf(mesh);
    progress(kParsedShare + (1 - kParsedShare) * ++done / static_cast<double>(shown.size()));
  }
  for (const PlacedMesh& placed : tree.placed) {
    std::vector<glm::dmat4> transforms = readInstancing(model, placed.node);
    if (!deformed.moves(placed)) {
      place(placed, meshes.primitivesOf(placed.mesh), transforms, -1, scene, rig);
      continue;
    }
    const DeformedMesh mesh = deformed.load(placed);
    if (mesh.skinned && transforms.size() > 1) {
      scene.notes.push_back(
          fmt::format("nodes[{}]: a skin moves the mesh; drawn once, without its {} instances",
                      placed.node, transforms.size()));
      transforms.erase(transforms.begin() + 1, transforms.end());
    }
    place(placed, mesh.primitives, transforms, mesh.skinned ? mesh.index : -1, scene, rig);
  }
}

// Gives the scene its rig, at rest, if anything can move.
void finishRig(const tinygltf::Model& model, NodeTree tree, Rig rig, Scene& scene) {
  rig.nodes = std::move(tree.nodes);
  rig.order = std::move(tree.order);
  rig.animations = readAnimations(model, rig, scene.notes);
  const bool moves =
      !rig.deformed.empty() || std::ranges::any_of(rig.animations, [](const Animation& animation) {
        return !animation.channels.empty();
      });
  if (!moves) return;
  scene.rig = std::make_shared<const Rig>(std::move(rig));
  pose(scene, {});
}

Scene load(const std::string& path, const Progress& progress) {
  tinygltf::Model model;
  Scene scene;
  readModel(path, model, scene.notes);
  progress(kParsedShare);
  scene.name = std::filesystem::path(path).stem().string();
  MeshLoader meshes(model, loadMaterials(path, model, scene), scene);
  NodeTree tree = readNodes(model);
  Rig rig;
  addInstances(model, tree, meshes, scene, rig, progress);
  if (scene.instances.empty()) throw Error(ErrorId::kSceneEmpty, "the scene has no triangles");
  // Vertices without a triangle may still have a normal of length 0.
  for (glm::vec3& normal : scene.normals) {
    if (normal == glm::vec3(0)) normal = glm::vec3(0, 1, 0);
  }
  if (!scene.colours.empty()) scene.colours.resize(scene.positions.size(), glm::vec4(1));
  finishRig(model, std::move(tree), std::move(rig), scene);
  if (!scene.rig) computeBounds(scene);
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
