// SPDX-License-Identifier: MIT
// Poses a scene by its rig: node transforms, morph targets, then skins, in double precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/base/error.h"
#include "core/scene/normal_map.h"
#include "core/scene/rig.h"

namespace grisaille::scene {
namespace {

[[noreturn]] void refusePose(const char* what) {
  throw Error(ErrorId::kSceneInvalid, "the pose has {} that are not finite", what);
}

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The nodes that an animation moves, as they are at a time.
using MovedNodes = std::unordered_map<uint32_t, RigNode>;

MovedNodes movedBy(const Rig& rig, const Pose& pose) {
  MovedNodes moved;
  if (!pose.animation) return moved;
  const Animation& animation = rig.animations[*pose.animation];
  for (const Channel& channel : animation.channels) {
    RigNode& node = moved.try_emplace(channel.node, rig.nodes[channel.node]).first->second;
    const Keys& keys = animation.keys[channel.keys];
    std::vector<double> v = sample(keys, pose.seconds, channel.moved == Moved::kRotation);
    switch (channel.moved) {
      case Moved::kTranslation:
        node.translation = {v[0], v[1], v[2]};
        break;
      case Moved::kRotation:
        node.rotation = glm::dquat(v[3], v[0], v[1], v[2]);
        break;
      case Moved::kScale:
        node.scale = {v[0], v[1], v[2]};
        break;
      case Moved::kWeights:
        node.weights = std::move(v);
        break;
    }
  }
  return moved;
}

const RigNode& nodeAt(const Rig& rig, const MovedNodes& moved, uint32_t index) {
  const auto found = moved.find(index);
  return found == moved.end() ? rig.nodes[index] : found->second;
}

std::vector<glm::dmat4> worldsOf(const Rig& rig, const MovedNodes& moved) {
  std::vector<glm::dmat4> worlds(rig.nodes.size(), glm::dmat4(1));
  for (const uint32_t i : rig.order) {
    const RigNode& node = nodeAt(rig, moved, i);
    const glm::dmat4 local = localTransform(node);
    worlds[i] = node.parent < 0 ? local : worlds[static_cast<size_t>(node.parent)] * local;
  }
  return worlds;
}

struct Vertices {
  std::vector<glm::dvec3> positions, normals;
};

Vertices morphed(const DeformedVertices& from, const std::vector<double>& weights) {
  Vertices result{{from.positions.begin(), from.positions.end()},
                  {from.normals.begin(), from.normals.end()}};
  for (size_t k = 0; k < std::min(weights.size(), from.targets.size()); ++k) {
    const MorphTarget& target = from.targets[k];
    const double weight = weights[k];
    if (weight == 0) continue;
    for (size_t i = 0; i < target.vertices.size(); ++i) {
      const uint32_t vertex = target.vertices[i];
      result.positions[vertex] += weight * glm::dvec3(target.positions[i]);
      if (!target.normals.empty() && !result.normals.empty()) {
        result.normals[vertex] += weight * glm::dvec3(target.normals[i]);
      }
    }
  }
  return result;
}

// `joints`: world from mesh, for each joint. `node`: world from node, for vertices without a skin.
void skin(const DeformedVertices& from, const std::vector<glm::dmat4>& joints,
          const glm::dmat4& node, Vertices& vertices) {
  for (size_t i = 0; i < vertices.positions.size(); ++i) {
    glm::dmat4 map = node;
    if (!from.firstInfluence.empty()) {
      map = glm::dmat4(0);
      for (uint32_t k = from.firstInfluence[i]; k < from.firstInfluence[i + 1]; ++k) {
        map += double{from.influences[k].weight} * joints[from.influences[k].joint];
      }
    }
    vertices.positions[i] = glm::dvec3(map * glm::dvec4(vertices.positions[i], 1));
    if (!vertices.normals.empty()) {
      vertices.normals[i] = normalMap(glm::dmat3(map)) * vertices.normals[i];
    }
  }
}

glm::vec3 unit(const glm::dvec3& normal) {
  const double length = glm::length(normal);
  // Any normal will do for triangles without area and vertices without triangles.
  return length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
}

// Writes a run of the scene's vertices, relative to `centre`.
void write(const DeformedRun& run, const Vertices& from, const glm::dvec3& centre, Scene& scene) {
  const auto source = [&](uint32_t i) { return run.sources.empty() ? i : run.sources[i]; };
  for (uint32_t i = 0; i < run.vertexCount; ++i) {
    const glm::vec3 position(from.positions[source(i)] - centre);
    if (!isFinite(position)) refusePose("vertices");
    scene.positions[run.firstVertex + i] = position;
    if (!from.normals.empty()) scene.normals[run.firstVertex + i] = unit(from.normals[source(i)]);
  }
  if (!from.normals.empty()) return;
  for (uint32_t i = 0; i + 2 < run.vertexCount; i += 3) {
    const glm::dvec3& a = from.positions[source(i)];
    const glm::vec3 normal =
        unit(glm::cross(from.positions[source(i + 1)] - a, from.positions[source(i + 2)] - a));
    for (uint32_t k = 0; k < 3; ++k) scene.normals[run.firstVertex + i + k] = normal;
  }
}

class Poser {
 public:
  Poser(Scene& scene, const Pose& pose)
      : scene_(scene),
        rig_(*scene.rig),
        moved_(movedBy(rig_, pose)),
        worlds_(worldsOf(rig_, moved_)) {}

  void run() {
    for (const DeformedNode& deformed : rig_.deformed) centres_.push_back(deform(deformed));
    for (size_t i = 0; i < scene_.instances.size(); ++i) {
      const RigInstance& instance = rig_.instances[i];
      glm::dmat4& world = scene_.instances[i].worldFromObject;
      if (instance.deformed < 0) {
        world = worlds_[instance.node] * instance.nodeFromObject;
      } else {
        world = glm::dmat4(1);
        world[3] = glm::dvec4(centres_[static_cast<size_t>(instance.deformed)], 1);
      }
      for (int k = 0; k < 4; ++k) {
        if (!isFinite(glm::dvec3(world[k]))) refusePose("transforms");
      }
    }
    computeBounds(scene_);
    if (!isFinite(scene_.bounds.min) || !isFinite(scene_.bounds.max)) refusePose("bounds");
  }

 private:
  // Writes the vertices of a node and returns the point that they are relative to.
  glm::dvec3 deform(const DeformedNode& deformed) {
    std::vector<glm::dmat4> joints;
    if (deformed.skin >= 0) {
      const RigSkin& skin = rig_.skins[static_cast<size_t>(deformed.skin)];
      for (size_t i = 0; i < skin.joints.size(); ++i) {
        joints.push_back(worlds_[skin.joints[i]] * skin.inverseBinds[i]);
      }
    }
    std::vector<Vertices> runs;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    glm::dvec3 low(kFar), high(-kFar);
    for (const DeformedRun& run : deformed.runs) {
      const DeformedVertices& from = rig_.vertices[run.vertices];
      Vertices& vertices =
          runs.emplace_back(morphed(from, nodeAt(rig_, moved_, deformed.node).weights));
      if (deformed.skin < 0) continue;
      skin(from, joints, worlds_[deformed.node], vertices);
      for (const glm::dvec3& p : vertices.positions) {
        if (!isFinite(p)) refusePose("vertices");
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    const glm::dvec3 centre =
        deformed.skin < 0 || runs.empty() ? glm::dvec3(0) : low + (high - low) / 2.0;
    for (size_t i = 0; i < runs.size(); ++i) write(deformed.runs[i], runs[i], centre, scene_);
    return centre;
  }

  Scene& scene_;
  const Rig& rig_;
  MovedNodes moved_;
  std::vector<glm::dmat4> worlds_;   // world from node
  std::vector<glm::dvec3> centres_;  // one for each of Rig::deformed
};

}  // namespace

glm::dmat4 localTransform(const RigNode& node) {
  if (node.matrix) return *node.matrix;
  const glm::dmat3 turn = glm::mat3_cast(node.rotation);
  glm::dmat4 matrix(1);
  for (int i = 0; i < 3; ++i) matrix[i] = glm::dvec4(turn[i] * node.scale[i], 0);
  matrix[3] = glm::dvec4(node.translation, 1);
  return matrix;
}

std::vector<glm::dmat4> nodeTransforms(const Rig& rig, const Pose& pose) {
  return worldsOf(rig, movedBy(rig, pose));
}

std::vector<bool> movingInstances(const Scene& scene) {
  std::vector<bool> result(scene.instances.size(), false);
  if (!scene.rig) return result;
  const Rig& rig = *scene.rig;
  std::vector<bool> placed(rig.nodes.size(), false), shaped(rig.nodes.size(), false);
  for (const Animation& animation : rig.animations) {
    for (const Channel& channel : animation.channels) {
      (channel.moved == Moved::kWeights ? shaped : placed)[channel.node] = true;
    }
  }
  for (const uint32_t i : rig.order) {
    const int parent = rig.nodes[i].parent;
    if (parent >= 0 && placed[static_cast<size_t>(parent)]) placed[i] = true;
  }
  for (size_t i = 0; i < result.size(); ++i) {
    const RigInstance& instance = rig.instances[i];
    bool moves = placed[instance.node] || shaped[instance.node];
    if (instance.deformed >= 0) {
      const DeformedNode& deformed = rig.deformed[static_cast<size_t>(instance.deformed)];
      const RigSkin& skin = rig.skins[static_cast<size_t>(deformed.skin)];
      moves |= placed[deformed.node] || shaped[deformed.node] ||
               std::ranges::any_of(skin.joints, [&](uint32_t joint) { return placed[joint]; });
    }
    result[i] = moves;
  }
  return result;
}

void pose(Scene& scene, const Pose& pose) {
  const size_t count = scene.rig ? scene.rig->animations.size() : 0;
  if (pose.animation && *pose.animation >= count) {
    throw Error(ErrorId::kSceneAnimation, "animation {}: the scene has {}", *pose.animation, count);
  }
  if (!std::isfinite(pose.seconds)) {
    throw Error(ErrorId::kSceneAnimation, "{} seconds are not a finite time", pose.seconds);
  }
  ++scene.poses;
  if (scene.rig) Poser(scene, pose).run();
}

}  // namespace grisaille::scene
