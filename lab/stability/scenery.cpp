// SPDX-License-Identifier: MIT
#include "lab/stability/scenery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/scene/mesh_builder.h"

namespace grisaille::lab::stability {
namespace {

using Kind = Scenery::Kind;

constexpr std::pair<Kind, const char*> kNames[] = {
    {Kind::kPlane, "plane"},
    {Kind::kCorner, "corner"},
    {Kind::kRoom, "room"},
    {Kind::kWires, "wires"},
    {Kind::kPair, "two surfaces"},
    {Kind::kTriangle, "triangle"},
    {Kind::kSky, "sky"},
    {Kind::kNoNormals, "room without normals"},
    {Kind::kBackNormals, "room, normals turned away"},
    {Kind::kAtNear, "all at depth 1"},
    {Kind::kAtFar, "all nearly at depth 0"},
    {Kind::kMixed, "depth 0, 1 and between"},
    {Kind::kNormless, "picture without normals"},
};

// `corners` run counter-clockwise, seen from the front.
void addFace(scene::Scene& scene, std::initializer_list<glm::vec3> corners, glm::vec3 normal) {
  const auto first = static_cast<uint32_t>(scene.positions.size());
  const auto firstIndex = static_cast<uint32_t>(scene.indices.size());
  for (const glm::vec3& corner : corners) {
    scene.positions.push_back(corner);
    scene.normals.push_back(normal);
    scene.texCoords.emplace_back(0);
  }
  for (uint32_t i = 2; i < corners.size(); ++i) {
    scene.indices.insert(scene.indices.end(), {first, first + i - 1, first + i});
  }
  scene.primitives.push_back(
      {.firstIndex = firstIndex,
       .indexCount = static_cast<uint32_t>(scene.indices.size()) - firstIndex,
       .material = 0});
}

void addFloor(scene::Scene& scene, float half) {
  addFace(scene, {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}},
          {0, 1, 0});
}

void addWall(scene::Scene& scene, float from, float to, float z) {
  addFace(scene, {{-20, from, z}, {20, from, z}, {20, to, z}, {-20, to, z}}, {0, 0, 1});
}

void addBox(scene::Scene& scene, const glm::dvec3& low, const glm::dvec3& high) {
  scene::addPrimitive(scene, scene::box(low, high), 1, 0.9);
}

void addRoom(scene::Scene& scene) {
  addFloor(scene, 20);
  addWall(scene, 0, 20, 0);
  addBox(scene, {-0.9, 0, 0.3}, {-0.3, 0.5, 0.8});
  addBox(scene, {0.35, 0, 0.15}, {0.6, 1.1, 0.4});
  addBox(scene, {0.1, 0, 0.75}, {0.13, 0.9, 0.78});  // a pole
}

void addWires(scene::Scene& scene) {
  addWall(scene, -20, 20, 0);
  for (int i = 0; i < 12; ++i) {
    const double x = -1.1 + 0.2 * i, half = i % 2 == 0 ? 0.0001 : 0.001;
    addBox(scene, {x - half, -2, 0.2}, {x + half, 2, 0.2 + 2 * half});
    addBox(scene, {-2, x - half, 0.1}, {2, x + half, 0.1 + 2 * half});
  }
}

void addFaces(scene::Scene& scene, Kind kind) {
  switch (kind) {
    case Kind::kPlane:
      return addFloor(scene, 1000);
    case Kind::kCorner:
      addFloor(scene, 20);
      return addWall(scene, 0, 20, 0);
    case Kind::kWires:
      return addWires(scene);
    case Kind::kPair:
      addWall(scene, -20, 20, 0);
      return addWall(scene, 0.3f, 20, 1e-6f);
    case Kind::kTriangle:
      return addFace(scene, {{-0.5, 0.1, 0.5}, {0.6, 0.3, 0.2}, {0, 1, 0.4}}, {0, 0, 1});
    case Kind::kSky:
      return addFace(scene, {{-1, -1, 50}, {1, -1, 50}, {0, 1, 50}}, {0, 0, -1});
    default:
      return addRoom(scene);
  }
}

}  // namespace

const char* nameOf(Kind kind) {
  return std::ranges::find(kNames, kind, &std::pair<Kind, const char*>::first)->second;
}

scene::Scene makeScene(const Scenery& scenery) {
  scene::Scene scene;
  scene.name = nameOf(scenery.kind);
  scene.materials.push_back({.name = "white", .doubleSided = true});
  scene.materials.push_back({.name = "solid", .baseColor = {0.8f, 0.35f, 0.1f, 1}});
  addFaces(scene, scenery.kind);
  for (glm::vec3& normal : scene.normals) {
    if (scenery.kind == Kind::kNoNormals) normal = glm::vec3(0);
    if (scenery.kind == Kind::kBackNormals) normal = -normal;
  }
  const glm::dmat4 world = scene::moved(scenery.origin) * glm::dmat4(glm::dmat3(scenery.scale));
  for (uint32_t i = 0; i < scene.primitives.size(); ++i) {
    scene.instances.push_back({.primitive = i, .worldFromObject = world});
  }
  scene::computeBounds(scene);
  return scene;
}

frame::Pictures makePictures(const Scenery& scenery, const scene::Camera& camera,
                             const glm::uvec2& size) {
  frame::Pictures pictures;
  pictures.viewDepth = {.width = size.x, .height = size.y, .channels = 1, .pixels = {}};
  pictures.normal = {.width = size.x, .height = size.y, .channels = 3, .pixels = {}};
  const glm::vec3 towards(glm::normalize(camera.eye - camera.target));
  const auto near = static_cast<float>(camera.nearPlane);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> decades(0, 8);
  for (uint32_t y = 0; y < size.y; ++y) {
    for (uint32_t x = 0; x < size.x; ++x) {
      float depth = near;
      if (scenery.kind == Kind::kAtFar) depth = 9e8f;
      if (scenery.kind == Kind::kMixed) {
        const uint32_t which = random() % 4;
        depth = which == 0 ? 0 : which == 1 ? near : near * std::pow(10.0f, decades(random));
      }
      const bool hole = x / 8 % 3 == 0 && y / 8 % 3 == 0;
      if (scenery.kind == Kind::kNormless) {
        depth = hole ? 0.0f : static_cast<float>(scenery.scale * (2 + 0.01 * x + 0.3 * (y / 16)));
      }
      pictures.viewDepth.pixels.push_back(depth);
      const glm::vec3 normal =
          depth > 0 && scenery.kind != Kind::kNormless ? towards : glm::vec3(0);
      pictures.normal.pixels.insert(pictures.normal.pixels.end(), {normal.x, normal.y, normal.z});
    }
  }
  return pictures;
}

Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
            double range) {
  const glm::vec3 direction(glm::normalize(target - origin));
  return {.origin = {origin.x, origin.y, origin.z},
          .direction = {direction.x, direction.y, direction.z},
          .color = {color.x, color.y, color.z},
          .range = range};
}

std::vector<Shot> makeShots(const Scenery& scenery, size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Shot> all;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 origin(3 * unit(random) - 1.5, 0.2 + 2 * unit(random), 0.2 + 2 * unit(random));
    const bool wall = i % 2 == 0;
    const glm::dvec3 target(2.4 * unit(random) - 1.2, wall ? 1.5 * unit(random) : 0,
                            wall ? 0 : 1.5 * unit(random));
    const double range = i % 4 == 3 ? (0.05 + 0.4 * unit(random)) * scenery.scale : 0;
    const glm::vec3 color(unit(random), unit(random), unit(random));
    all.push_back(shotAt(scenery.placed(origin), scenery.placed(target), color, range));
  }
  return all;
}

}  // namespace grisaille::lab::stability
