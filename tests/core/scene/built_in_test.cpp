// SPDX-License-Identifier: MIT
// Properties of every built-in scene.
#include "core/scene/built_in.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "core/base/error.h"
#include "core/image/image.h"
#include "core/scene/bodies.h"
#include "core/scene/camera.h"
#include "tests/core/scene/mesh_checks.h"
#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille::scene {
namespace {

// Each scene, built once.
const Scene& sceneOf(const std::string& name) {
  static std::map<std::string, Scene> scenes;
  const auto found = scenes.find(name);
  return found != scenes.end() ? found->second
                               : scenes.emplace(name, loadScene(name)).first->second;
}

uint64_t hashOf(const Scene& scene) {
  uint64_t state = 0xcbf29ce484222325u;  // FNV-1a over 64 bits
  const auto add = [&](const auto* values, size_t count) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values);
    for (size_t i = 0; i < count * sizeof *values; ++i) {
      state = (state ^ bytes[i]) * 0x100000001b3u;
    }
  };
  add(scene.positions.data(), scene.positions.size());
  add(scene.normals.data(), scene.normals.size());
  add(scene.texCoords.data(), scene.texCoords.size());
  add(scene.indices.data(), scene.indices.size());
  for (const Instance& instance : scene.instances) add(&instance.worldFromObject, 1);
  for (const Texture& texture : scene.textures) {
    add(texture.texels.pixels.data(), texture.texels.pixels.size());
  }
  return state;
}

// How many bodies hold a point: the generalised winding number of all bodies. Van Oosterom and
// Strackee, "The Solid Angle of a Plane Triangle", IEEE Transactions on Biomedical Engineering
// 30(2), 1983, equation 8. `bodies`: whether each triangle belongs to one
double bodiesAround(const Scene& scene, const std::vector<bool>& bodies, const glm::dvec3& point) {
  double sum = 0;
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    for (uint32_t i = primitive.firstIndex; i < primitive.firstIndex + primitive.indexCount;
         i += 3) {
      if (!bodies[i / 3]) continue;
      const auto at = [&](uint32_t k) {
        const glm::vec3& p = scene.positions[scene.indices[i + k]];
        return glm::dvec3(instance.worldFromObject * glm::dvec4(p, 1)) - point;
      };
      const glm::dvec3 a = at(0), b = at(1), c = at(2);
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      sum +=
          std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                        glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
  }
  return sum / (2 * std::numbers::pi);
}

class EachBuiltIn : public testing::TestWithParam<std::string> {
 protected:
  static const BuiltIn& builtIn() { return *findBuiltIn(GetParam()); }
  const Scene& scene() const { return sceneOf(GetParam()); }
};

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const BuiltIn& one : builtIns()) all.emplace_back(one.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, EachBuiltIn, testing::ValuesIn(names()),
                         [](const auto& tested) { return tested.param; });

TEST_P(EachBuiltIn, LoadsByItsName) {
  EXPECT_EQ(scene().name, GetParam());
  EXPECT_EQ(builtIn().name, GetParam());
  ASSERT_TRUE(scene().camera);
  EXPECT_NO_THROW(validate(*scene().camera));
  const double size = glm::length(scene().bounds.max - scene().bounds.min);
  EXPECT_GT(builtIn().radius, size / 500);
  EXPECT_LT(builtIn().radius, size / 10);
}

TEST_P(EachBuiltIn, HasADetailedMeshThatFitsTogether) {
  const Scene& mesh = scene();
  EXPECT_GE(triangleCount(mesh), 30000u);
  EXPECT_LE(triangleCount(mesh), mesh.name == "atrium" ? 120000u : 75000u);
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.texCoords.size(), mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) {
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  for (const Primitive& primitive : mesh.primitives) {
    ASSERT_LT(primitive.material, mesh.materials.size());
    ASSERT_EQ(primitive.indexCount % 3, 0u);
    ASSERT_LE(primitive.firstIndex + primitive.indexCount, mesh.indices.size());
  }
  std::vector<bool> shown(mesh.primitives.size(), false);
  for (const Instance& instance : mesh.instances) {
    shown.at(instance.primitive) = true;
    EXPECT_NEAR(glm::determinant(instance.worldFromObject), 1, 1e-9);
  }
  EXPECT_TRUE(std::ranges::all_of(shown, [](bool b) { return b; }));
}

TEST_P(EachBuiltIn, NormalsAreUnitAndAgreeWithTheWinding) {
  const Scene& mesh = scene();
  for (const uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
    const glm::dvec3 face = glm::cross(p(1) - p(0), p(2) - p(0));
    ASSERT_GT(glm::length(face), 0) << "triangle without area: " << i / 3;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 normal(mesh.normals[mesh.indices[i + k]]);
      ASSERT_NEAR(glm::length(normal), 1, 1e-6);
      ASSERT_GT(glm::dot(normal, glm::normalize(face)), 0.1) << i / 3;
    }
  }
}

// Leaves, grass and cloth are sheets, everything else is a closed body that faces outwards.
TEST_P(EachBuiltIn, OnlyDoubleSidedMaterialsAreSheets) {
  const Scene& mesh = scene();
  const std::vector<bool> bodies = matterOf(mesh).bodies;
  for (size_t i = 0; i < mesh.primitives.size(); ++i) {
    const Primitive& primitive = mesh.primitives[i];
    const Material& material = mesh.materials[primitive.material];
    const auto first = bodies.begin() + primitive.firstIndex / 3;
    const auto inBodies = std::count(first, first + primitive.indexCount / 3, true);
    if (material.doubleSided) {
      // A drape of the atrium hangs over a rail; matterOf() takes the loop for a body.
      EXPECT_TRUE(inBodies == 0 || mesh.name == "atrium") << i << ": " << material.name;
      continue;
    }
    EXPECT_EQ(inBodies, primitive.indexCount / 3) << i << ": " << material.name;
    EXPECT_EQ(openEdges(mesh, primitive), 0u) << i << ": " << material.name;
    EXPECT_GT(volume(mesh, primitive), 0) << i << ": " << material.name;
  }
}

TEST_P(EachBuiltIn, CamerasStandOutsideOfBodies) {
  const std::map<std::string, std::vector<std::string>> files = {
      {"atrium", {"atrium", "vases", "aisle", "gallery"}},
      {"leaves", {"leaves_fence", "leaves_crown"}},
      {"grating", {"grating_walk", "grating_below"}},
      {"street", {"street_pavement", "street_chimneys"}},
      {"table", {"table_near", "table_far"}},
      {"carving", {"carving_board", "carving_low"}}};
  std::vector<Camera> cameras{*scene().camera};
  for (const std::string& file : files.at(GetParam())) {
    cameras.push_back(loadCamera(STUDIES "/cameras/" + file + ".json"));
  }
  const std::vector<bool> bodies = matterOf(scene()).bodies;
  for (const Camera& camera : cameras) {
    EXPECT_LT(std::abs(bodiesAround(scene(), bodies, camera.eye)), 0.5) << cameraJson(camera);
  }
}

TEST_P(EachBuiltIn, IsTheSameTwice) {
  EXPECT_EQ(hashOf(builtIn().make()), hashOf(scene()));
}

// A compiler that reorders or fuses arithmetic changes the bits.
TEST(BuiltIns, AreTheSameOnEveryMachine) {
  const std::map<std::string, uint64_t> expected = {{"leaves", 5676797064000519583u},
                                                    {"grating", 2863780744196479240u},
                                                    {"street", 11465309530257947682u},
                                                    {"table", 13151420424013421986u},
                                                    {"carving", 17027202131006493206u}};
  for (const auto& [name, hash] : expected) EXPECT_EQ(hashOf(sceneOf(name)), hash) << name;
}

TEST(BuiltIns, TheEmptyNameIsTheAtrium) {
  EXPECT_STREQ(findBuiltIn("")->name, "atrium");
  EXPECT_EQ(loadScene("").name, "atrium");
  EXPECT_EQ(findBuiltIn("leaf"), nullptr);
  EXPECT_TRUE(builtInNames().starts_with("atrium, leaves, "));
}

std::string messageOf(const std::string& path) {
  try {
    loadScene(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BuiltIns, AnUnknownNameIsAnErrorThatNamesTheNearest) {
  EXPECT_ERROR(ErrorId::kSceneUnreadable, loadScene("leafs"));
  EXPECT_NE(messageOf("leafs").find("nearest is leaves"), std::string::npos) << messageOf("leafs");
  EXPECT_EQ(messageOf("cathedral").find("nearest"), std::string::npos);
  EXPECT_NE(messageOf("cathedral").find(builtInNames()), std::string::npos);
  // Paths keep the file's own error.
  EXPECT_EQ(messageOf("leafs.glb").find("built-in"), std::string::npos);
  EXPECT_EQ(messageOf("./leaves").find("built-in"), std::string::npos);
}

using BuiltInFiles = tests::FolderTest;

TEST_F(BuiltInFiles, AFileWithoutExtensionLoads) {
  writeGlb(sceneOf("carving"), file("scene"));
  EXPECT_EQ(triangleCount(loadScene(file("scene"))), triangleCount(sceneOf("carving")));
}

// The table of the manual's page on scenes.
TEST_F(BuiltInFiles, TheManualListsThem) {
  const std::string page = contentOf(MANUAL "/scenes.md");
  for (const BuiltIn& one : builtIns()) {
    std::ostringstream row;
    row << "| `" << one.name << "` | " << one.about << " | " << one.radius << " m |";
    EXPECT_NE(page.find(row.str()), std::string::npos) << row.str();
  }
}

}  // namespace
}  // namespace grisaille::scene
