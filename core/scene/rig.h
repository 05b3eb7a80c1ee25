// SPDX-License-Identifier: MIT
// The moving parts of a scene: the file's nodes, skins, morph targets and animations, and the
// function that poses the scene by them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace grisaille::scene {

struct RigNode {
  int parent = -1;  // index into Rig::nodes, -1: none
  glm::dvec3 translation = glm::dvec3(0);
  glm::dquat rotation = glm::dquat(1, 0, 0, 0);  // unit
  glm::dvec3 scale = glm::dvec3(1);
  std::optional<glm::dmat4> matrix;  // affine; replaces the three above
  std::vector<double> weights;       // of the morph targets of the node's mesh, at rest
};

// Parent from node, as the node has it at rest.
glm::dmat4 localTransform(const RigNode& node);

struct RigSkin {
  std::vector<uint32_t> joints;          // indices into Rig::nodes
  std::vector<glm::dmat4> inverseBinds;  // joint from mesh; one for each joint
};

// The vertices that a morph target moves, and by how much. `normals` may be empty.
struct MorphTarget {
  std::vector<uint32_t> vertices;
  std::vector<glm::vec3> positions, normals;
};

struct Influence {
  uint32_t joint = 0;  // index into RigSkin::joints
  float weight = 0;
};

// The vertices of a deformed mesh as the file holds them. Several runs may share them.
struct DeformedVertices {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // empty: normals are those of the triangles
  // Vertex i has the influences firstInfluence[i] ... firstInfluence[i + 1] - 1, whose weights add
  // up to 1. Empty: no skin moves the vertices.
  std::vector<uint32_t> firstInfluence;
  std::vector<Influence> influences;
  std::vector<MorphTarget> targets;
};

// A run of the scene's vertices that pose() writes.
struct DeformedRun {
  uint32_t vertices = 0;  // index into Rig::vertices
  uint32_t firstVertex = 0;
  uint32_t vertexCount = 0;
  // For each vertex of the run its index in DeformedVertices, three for each triangle. Empty: the
  // vertices are the same in both.
  std::vector<uint32_t> sources;
  bool mirrored = false;  // the skin mirrors at rest: triangles' own normals point the other way
};

// A node with a skinned or morphed mesh. Its skinned vertices are relative to a translation, which
// is the transform of its instances; vertices without a skin are relative to the node.
struct DeformedNode {
  uint32_t node = 0;
  int skin = -1;  // index into Rig::skins, -1: morph targets alone
  std::vector<DeformedRun> runs;
};

// The place of one of the scene's instances.
struct RigInstance {
  uint32_t node = 0;
  int deformed = -1;  // index into Rig::deformed if a skin moves the instance, else -1
  glm::dmat4 nodeFromObject = glm::dmat4(1);
};

enum class Interpolation : uint8_t { kStep, kLinear, kCubicSpline };

// Keys of one property. A key holds `width` numbers; with cubic splines it holds three times as
// many: in-tangent, value, out-tangent.
struct Keys {
  Interpolation interpolation = Interpolation::kLinear;
  uint32_t width = 0;
  std::vector<float> seconds;  // ascending
  std::vector<float> values;
};

enum class Moved : uint8_t { kTranslation, kRotation, kScale, kWeights };

struct Channel {
  uint32_t node = 0;
  Moved moved = Moved::kTranslation;
  uint32_t keys = 0;  // index into Animation::keys
};

struct Animation {
  std::string name;
  double duration = 0;  // seconds; the time of the last key
  std::vector<Keys> keys;
  std::vector<Channel> channels;
};

struct Rig {
  std::vector<RigNode> nodes;
  std::vector<uint32_t> order;  // the nodes that count, parents before their children
  std::vector<RigSkin> skins;
  std::vector<DeformedVertices> vertices;
  std::vector<DeformedNode> deformed;
  std::vector<RigInstance> instances;  // one for each of the scene's
  std::vector<Animation> animations;
};

// A moment of an animation. Without an animation, nodes have their own transforms and morph targets
// their default weights. Beyond the first and the last key an animation holds their values.
struct Pose {
  std::optional<size_t> animation;  // index into Rig::animations
  double seconds = 0;

  bool operator==(const Pose&) const = default;
};

// The numbers of `keys` at a time. `rotation`: they are quaternions, which are interpolated along
// the shorter arc and returned as unit.
std::vector<double> sample(const Keys& keys, double seconds, bool rotation);

// World from node, for each node of the rig. Nodes outside Rig::order: the identity. The pose's
// animation must exist.
std::vector<glm::dmat4> nodeTransforms(const Rig& rig, const Pose& pose);

// For each of the scene's instances, whether any animation can move it or change its shape.
std::vector<bool> movingInstances(const Scene& scene);

// Sets the transforms of the scene's instances, the positions and normals of deformed vertices, and
// the bounds. Throws kSceneAnimation if the scene has no such animation or `seconds` is not finite,
// and kSceneInvalid if the pose leaves the range of numbers: pose the scene again before you use
// it.
void pose(Scene& scene, const Pose& pose);

}  // namespace grisaille::scene
