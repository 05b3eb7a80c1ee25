// SPDX-License-Identifier: MIT
#include "core/scene/gltf_nodes.h"

#include <tiny_gltf.h>

#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

namespace grisaille::scene {
namespace {

[[noreturn]] void refuseNode(int node, std::string_view why) {
  throw Error(ErrorId::kSceneInvalid, "nodes[{}] {}", node, why);
}

glm::dvec3 vec3Of(const std::vector<double>& values, const glm::dvec3& missing, int node) {
  if (values.empty()) return missing;
  if (values.size() != 3) refuseNode(node, "has a transform of the wrong length");
  return {values[0], values[1], values[2]};
}

glm::dmat4 matrixOf(const tinygltf::Node& node, int index) {
  glm::dmat4 matrix(1);
  if (node.matrix.size() != 16) refuseNode(index, "has a matrix of the wrong length");
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
  for (int i = 0; i < 4; ++i) {
    if (!(std::abs(matrix[i].w - (i == 3 ? 1 : 0)) < 1e-6)) {
      refuseNode(index, "has a matrix that is not affine");
    }
    matrix[i].w = i == 3 ? 1 : 0;
  }
  return matrix;
}

RigNode nodeOf(const tinygltf::Node& node, int index) {
  RigNode result;
  if (!node.matrix.empty()) {
    result.matrix = matrixOf(node, index);
    return result;
  }
  result.translation = vec3Of(node.translation, glm::dvec3(0), index);
  result.scale = vec3Of(node.scale, glm::dvec3(1), index);
  if (!node.rotation.empty()) {
    if (node.rotation.size() != 4) refuseNode(index, "has a rotation of the wrong length");
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1],
                              node.rotation[2]);
    if (!(glm::length(rotation) > 1e-9)) refuseNode(index, "has a rotation without length");
    result.rotation = glm::normalize(rotation);
  }
  return result;
}

// Returns the nodes without a parent among those that are not yet `seen`.
std::vector<int> orphansOf(const tinygltf::Model& model, const std::vector<bool>& seen) {
  std::vector<bool> held = seen;
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    if (seen[i]) continue;
    for (const int child : model.nodes[i].children) {
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

// Returns the root nodes: of the default scene, else of the first scene, else all nodes without a
// parent.
std::vector<int> rootsOf(const tinygltf::Model& model) {
  if (model.scenes.empty()) return orphansOf(model, std::vector<bool>(model.nodes.size(), false));
  const int index = model.defaultScene == -1 ? 0 : model.defaultScene;
  if (index < 0 || static_cast<size_t>(index) >= model.scenes.size()) {
    throw Error(ErrorId::kSceneInvalid, "scene {} does not exist", index);
  }
  return model.scenes[static_cast<size_t>(index)].nodes;
}

class TreeReader {
 public:
  explicit TreeReader(const tinygltf::Model& model)
      : model_(model), seen_(model.nodes.size(), false) {
    tree_.nodes.resize(model.nodes.size());
  }

  NodeTree read() {
    visit(rootsOf(model_), true);
    if (lacksJoint()) visit(orphansOf(model_, seen_), false);
    return std::move(tree_);
  }

 private:
  // Visits the nodes depth first, in file order. Uses an explicit stack instead of recursion,
  // because a file may nest nodes to any depth.
  void visit(const std::vector<int>& roots, bool shown) {
    struct Visit {
      int node, parent;
      glm::dmat4 worldFromParent;
    };
    std::vector<Visit> stack;
    const auto push = [&](const std::vector<int>& nodes, int parent, const glm::dmat4& world) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
        stack.push_back({*node, parent, world});
      }
    };
    push(roots, -1, glm::dmat4(1));
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const auto index = static_cast<size_t>(visit.node);
      if (visit.node < 0 || index >= model_.nodes.size()) refuseNode(visit.node, "does not exist");
      if (seen_[index]) refuseNode(visit.node, "is reached twice: the nodes do not form a tree");
      seen_[index] = true;
      const tinygltf::Node& from = model_.nodes[index];
      RigNode& node = tree_.nodes[index];
      node = nodeOf(from, visit.node);
      node.parent = visit.parent;
      tree_.order.push_back(static_cast<uint32_t>(index));
      const glm::dmat4 world = visit.worldFromParent * localTransform(node);
      for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(world[i / 4][i % 4]))
          refuseNode(visit.node, "has a world transform that is not finite");
      }
      if (shown && from.mesh != -1) {
        tree_.placed.push_back({from.mesh, static_cast<uint32_t>(index), world});
      }
      push(from.children, visit.node, world);
    }
  }

  // Whether a skin that the scene shows has a joint outside the scene.
  bool lacksJoint() const {
    for (const PlacedMesh& placed : tree_.placed) {
      const int skin = model_.nodes[placed.node].skin;
      if (skin < 0 || static_cast<size_t>(skin) >= model_.skins.size()) continue;
      for (const int joint : model_.skins[static_cast<size_t>(skin)].joints) {
        if (joint >= 0 && static_cast<size_t>(joint) < seen_.size() &&
            !seen_[static_cast<size_t>(joint)]) {
          return true;
        }
      }
    }
    return false;
  }

  const tinygltf::Model& model_;
  std::vector<bool> seen_;
  NodeTree tree_;
};

// Returns the accessor of an attribute of EXT_mesh_gpu_instancing, -1: none.
int instancingAccessor(const tinygltf::Value& attributes, const std::string& name,
                       const std::string& place) {
  if (!attributes.Has(name)) return -1;
  const tinygltf::Value& value = attributes.Get(name);
  if (!value.IsInt() || value.GetNumberAsInt() < 0) {
    throw Error(ErrorId::kSceneInvalid, "{}.{} is not the index of an accessor", place, name);
  }
  return value.GetNumberAsInt();
}

}  // namespace

NodeTree readNodes(const tinygltf::Model& model) {
  return TreeReader(model).read();
}

std::vector<glm::dmat4> readInstancing(const tinygltf::Model& model, uint32_t index) {
  const auto& extensions = model.nodes[index].extensions;
  const auto found = extensions.find("EXT_mesh_gpu_instancing");
  if (found == extensions.end()) return {glm::dmat4(1)};
  const std::string place =
      fmt::format("nodes[{}].extensions.EXT_mesh_gpu_instancing.attributes", index);
  if (!found->second.IsObject() || !found->second.Has("attributes") ||
      !found->second.Get("attributes").IsObject()) {
    throw Error(ErrorId::kSceneInvalid, "{} is missing", place);
  }
  const tinygltf::Value& attributes = found->second.Get("attributes");
  size_t count = 0;
  for (const std::string& name : attributes.Keys()) {
    const int accessor = instancingAccessor(attributes, name, place);
    const uint64_t given =
        inPlace(place + "." + name, [&] { return accessorCount(model, accessor); });
    if (given > kMaxInstances) {
      throw Error(ErrorId::kSceneTooLarge, "{}.{}: {} instances; the limit is {}", place, name,
                  given, kMaxInstances);
    }
    if (given == 0 || (count != 0 && given != count)) {
      throw Error(ErrorId::kSceneInvalid, "{}.{}: {} elements; the other attributes have {}", place,
                  name, given, count);
    }
    count = given;
  }
  if (count == 0) return {glm::dmat4(1)};
  const auto read = [&](const std::string& name, auto&& reader, auto missing) {
    const int accessor = instancingAccessor(attributes, name, place);
    if (accessor < 0) return std::vector(count, missing);
    return inPlace(place + "." + name, [&] { return reader(model, accessor); });
  };
  const auto translations = read("TRANSLATION", readVec3, glm::vec3(0));
  const auto rotations = read("ROTATION", readVec4, glm::vec4(0, 0, 0, 1));
  const auto scales = read("SCALE", readVec3, glm::vec3(1));
  std::vector<glm::dmat4> result;
  result.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const glm::dquat rotation(rotations[i].w, rotations[i].x, rotations[i].y, rotations[i].z);
    if (!(glm::length(rotation) > 1e-9)) {
      throw Error(ErrorId::kSceneInvalid, "{}.ROTATION: element {} has no length", place, i);
    }
    RigNode node;
    node.translation = translations[i];
    node.rotation = glm::normalize(rotation);
    node.scale = scales[i];
    result.push_back(localTransform(node));
  }
  return result;
}

}  // namespace grisaille::scene
