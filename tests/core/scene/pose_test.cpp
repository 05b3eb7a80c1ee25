// SPDX-License-Identifier: MIT
// Skins, morph targets, instancing and animations, compared with the reference, for real files and
// for small ones that are made here.
#include <cmath>
#include <limits>

#include "core/scene/rig.h"
#include "tests/core/scene/gltf_builder.h"
#include "tests/core/scene/reference_pose.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

class PoseFiles : public SceneFiles {
 protected:
  // Compares the scene with the reference at rest and at three times of each animation. Returns the
  // number of corners that were compared.
  static size_t expectAgrees(const std::string& path) {
    Scene scene = loadGltf(path);
    ReferenceGltf reference(path);
    size_t compared = compare(scene, reference, {});
    const size_t animations = scene.rig ? scene.rig->animations.size() : 0;
    EXPECT_EQ(animations, reference.document().value("animations", json::array()).size());
    for (size_t a = 0; a < animations; ++a) {
      const double duration = reference.duration(a);
      EXPECT_EQ(scene.rig->animations[a].duration, duration);
      for (const double share : {0.13, 0.5, 0.97}) {
        const Pose at{.animation = a, .seconds = share * duration};
        pose(scene, at);
        reference.pose(a, at.seconds);
        compared += compare(scene, reference, at);
      }
    }
    // Posing leaves no trace.
    pose(scene, {});
    reference.pose({}, 0);
    compare(scene, reference, {});
    return compared;
  }

  static size_t compare(const Scene& scene, const ReferenceGltf& reference, const Pose& at) {
    const auto corners = reference.corners();
    EXPECT_EQ(corners.size(), scene.instances.size());
    if (corners.size() != scene.instances.size()) return 0;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const auto& primitive : corners) {
      for (const glm::dvec3& p : primitive) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    const double size = glm::length(high - low);
    double farthest = 0;
    size_t count = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Instance& instance = scene.instances[i];
      const Primitive& primitive = scene.primitives[instance.primitive];
      EXPECT_EQ(primitive.indexCount, corners[i].size()) << i;
      if (primitive.indexCount != corners[i].size()) return 0;
      for (size_t k = 0; k < corners[i].size(); ++k, ++count) {
        const glm::vec3& p = scene.positions[scene.indices[primitive.firstIndex + k]];
        const glm::dvec3 world(instance.worldFromObject * glm::dvec4(p, 1));
        farthest = std::max(farthest, glm::distance(world, corners[i][k]));
      }
    }
    EXPECT_LT(farthest, 1e-4 * size) << at.seconds << " s";
    // The bounds are those of boxes, which may be larger.
    EXPECT_TRUE(glm::all(glm::lessThan(scene.bounds.min, low + 1e-4 * size)));
    EXPECT_TRUE(glm::all(glm::greaterThan(scene.bounds.max, high - 1e-4 * size)));
    if (scene.rig) {
      const std::vector<glm::dmat4> worlds = nodeTransforms(*scene.rig, at);
      for (const RigSkin& skin : scene.rig->skins) {
        for (const uint32_t joint : skin.joints) {
          const glm::dvec3 expected(reference.world(joint)[3]);
          EXPECT_LT(glm::distance(glm::dvec3(worlds[joint][3]), expected), 1e-4 * size) << joint;
        }
      }
    }
    return count;
  }
};

class SharedModels : public PoseFiles, public ::testing::WithParamInterface<const char*> {};

TEST_P(SharedModels, ArePosedAsTheSpecificationSays) {
  const std::string path = std::string(SHARED_MODELS) + "/" + GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "missing: " << path;
  EXPECT_GT(expectAgrees(path), 0u);
}
INSTANTIATE_TEST_SUITE_P(
    , SharedModels,
    ::testing::Values("fox.glb", "bitmoji_walk.glb", "instancing.glb",
                      "simple_skin/SimpleSkin.gltf", "skinned_cylinder/03_skinned_cylinder.gltf",
                      "simple_morph/SimpleMorph.gltf", "morph_stress/MorphStressTest.gltf",
                      "animation_pointer/24_animation_pointer.gltf", "lights/sphere_lights.gltf",
                      "unlit_ship/craft_speederD.gltf", "vertex_colours/VertexColorTest.gltf"),
    [](const auto& model) {
      std::string name = model.param;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      return name;
    });

// A strip of two triangles, bent by two joints, morphed by two targets, and animated in all ways.
struct Bent : Gltf {
  Bent() : Gltf(triangle()) {
    document["nodes"] = json::parse(R"([
        {"children": [1, 3], "translation": [0.5, 1, 2], "scale": [2, 2, 2]},
        {"children": [2], "rotation": [0, 0, 0.3826834, 0.9238795]},
        {"translation": [0, 1, 0]},
        {"mesh": 0, "skin": 0, "translation": [100, 100, 100]}])");
    document["skins"] = json::parse(R"([{"joints": [1, 2]}])");
    std::vector<float> binds(32, 0.0f);
    for (const size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) binds[i] = 1;
    binds[16 + 13] = -1;
    const int view32 = view(binds.data(), binds.size() * 4);
    document["accessors"].push_back(
        {{"bufferView", view32}, {"componentType", 5126}, {"count", 2}, {"type", "MAT4"}});
    document["skins"][0]["inverseBindMatrices"] = document["accessors"].size() - 1;
    setWeights<uint8_t, float>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0},
                               {0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.25f, 0.25f, 0, 0});
    primitive()["targets"] =
        json::array({{{"POSITION", accessor<float>({0, 0, 1, 0, 0, 0, 0, 0, 0}, 3)}},
                     {{"POSITION", accessor<float>({0, 0, 0, 0, 0, 0, 1, 0, 0.5f}, 3)}}});
    document["meshes"][0]["weights"] = {0.5, 0.25};
  }

  template <typename Joint, typename Weight>
  void setWeights(const std::vector<Joint>& joints, const std::vector<Weight>& weights,
                  int set = 0) {
    const std::string n = std::to_string(set);
    primitive()["attributes"]["JOINTS_" + n] = accessor<Joint>(joints, 4);
    primitive()["attributes"]["WEIGHTS_" + n] = accessor<Weight>(weights, 4);
    if (!std::is_floating_point_v<Weight>) document["accessors"].back()["normalized"] = true;
  }

  void animate(const char* path, size_t node, size_t width, const std::string& interpolation) {
    const size_t parts = interpolation == "CUBICSPLINE" ? 3 : 1;
    std::vector<float> values;
    for (size_t i = 0; i < 3 * parts * width; ++i) {
      values.push_back(std::sin(1.7f * static_cast<float>(i + width)) * 0.4f +
                       (i % 5 == 0 ? 1 : 0));
    }
    // Rotations of linear keys are unit.
    for (size_t i = 0; width == 4 && i < values.size(); i += 4) {
      const float length = std::sqrt(values[i] * values[i] + values[i + 1] * values[i + 1] +
                                     values[i + 2] * values[i + 2] + values[i + 3] * values[i + 3]);
      for (size_t c = 0; c < 4; ++c) values[i + c] /= length;
    }
    const bool weights = std::string(path) == "weights";
    json& animation = document["animations"][0];
    animation["channels"].push_back({{"sampler", animation.value("samplers", json::array()).size()},
                                     {"target", {{"node", node}, {"path", path}}}});
    const int times = accessor<float>({0.5f, 1, 3}, 1);
    animation["samplers"].push_back({{"input", times},
                                     {"output", accessor(values, weights ? 1 : width)},
                                     {"interpolation", interpolation}});
  }
};

TEST_F(PoseFiles, EveryPathAndInterpolation) {
  for (const char* interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
    Bent gltf;
    gltf.animate("translation", 2, 3, interpolation);
    gltf.animate("rotation", 1, 4, interpolation);
    gltf.animate("scale", 0, 3, interpolation);
    gltf.animate("weights", 3, 2, interpolation);
    SCOPED_TRACE(interpolation);
    const std::string path = put("a.glb", gltf.bytes());
    EXPECT_GT(expectAgrees(path), 0u);
    // Before the first and after the last key, their values hold.
    Scene early = loadGltf(path), first = early, late = early, last = early;
    pose(early, {.animation = 0, .seconds = -4});
    pose(first, {.animation = 0, .seconds = 0.5});
    pose(late, {.animation = 0, .seconds = 1e9});
    pose(last, {.animation = 0, .seconds = 3});
    EXPECT_EQ(early.positions, first.positions);
    EXPECT_EQ(late.positions, last.positions);
    EXPECT_NE(first.positions, last.positions);
  }
}

TEST_F(PoseFiles, AllTypesOfJointsAndWeights) {
  const std::vector<uint8_t> joints8{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
  const std::vector<uint16_t> joints16(joints8.begin(), joints8.end());
  const auto agrees = [&](auto&& change) {
    Bent gltf;
    change(gltf);
    expectAgrees(put("a.glb", gltf.bytes()));
  };
  agrees([&](Bent& g) {
    g.setWeights<uint16_t, uint8_t>(joints16, {128, 127, 0, 0, 255, 0, 0, 0, 100, 155, 0, 0});
  });
  agrees([&](Bent& g) {
    g.setWeights<uint8_t, uint16_t>(joints8, {30000, 35535, 0, 0, 65535, 0, 0, 0, 5, 65530, 0, 0});
  });
  // Eight influences, whose sum is not 1.
  agrees([&](Bent& g) {
    g.setWeights<uint8_t, float>(joints8, {0.5f, 0.1f, 0, 0, 1, 0, 0, 0, 0.2f, 0.3f, 0, 0}, 1);
  });
  agrees([](Bent& g) { g.document["skins"][0].erase("inverseBindMatrices"); });
  agrees([](Bent& g) { g.document["nodes"][3]["weights"] = {0, 1}; });
  agrees([](Bent& g) { g.primitive()["attributes"].erase("NORMAL"); });
}

TEST_F(PoseFiles, SparseMorphTargets) {
  Bent gltf;
  const std::vector<uint16_t> where{2};
  const std::vector<float> what{0, 3, 1};
  const json sparse = {
      {"count", 1},
      {"indices", {{"bufferView", gltf.view(where.data(), 2)}, {"componentType", 5123}}},
      {"values", {{"bufferView", gltf.view(what.data(), 12)}}}};
  gltf.document["accessors"].push_back(
      {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  gltf.primitive()["targets"][0]["POSITION"] = gltf.document["accessors"].size() - 1;
  gltf.document["nodes"][3].erase("skin");
  const std::string path = put("a.glb", gltf.bytes());
  expectAgrees(path);
  EXPECT_FLOAT_EQ(loadGltf(path).positions[2].y, 2.5f);
}

TEST_F(PoseFiles, FarAwaySkinsKeepTheirPrecision) {
  Bent gltf;
  gltf.document["nodes"][0]["translation"] = {6.4e6, -6.4e6, 1e7};
  gltf.document["nodes"][0].erase("scale");
  const std::string path = put("a.glb", gltf.bytes());
  const Scene scene = loadGltf(path);
  const auto corners = ReferenceGltf(path).corners();
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec3 world(scene.instances[0].worldFromObject *
                           glm::dvec4(scene.positions[scene.indices[k]], 1));
    EXPECT_LT(glm::distance(world, corners[0][k]), 1e-6);
  }
}

TEST_F(PoseFiles, NodesShareNoDeformedVertices) {
  Bent gltf;
  gltf.document["nodes"].push_back({{"mesh", 0}, {"weights", {0, 0}}});
  gltf.document["scenes"][0]["nodes"] = {0, 4};
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  EXPECT_EQ(scene.positions.size(), 6u);
  EXPECT_EQ(scene.primitives.size(), 2u);
  EXPECT_EQ(scene.rig->vertices.size(), 2u);  // one has a skin
}

TEST_F(PoseFiles, StaticFilesHaveNoRig) {
  const Scene scene = loadGltf(put("a.glb", Gltf::triangle().bytes()));
  EXPECT_EQ(scene.rig, nullptr);
  EXPECT_TRUE(scene.colours.empty());
  EXPECT_TRUE(scene.notes.empty());
  Scene still = scene;
  pose(still, {});
  EXPECT_ERROR(ErrorId::kSceneAnimation, pose(still, {.animation = 0}));
  EXPECT_ERROR(ErrorId::kSceneAnimation,
               pose(still, {.animation = {}, .seconds = std::numeric_limits<double>::quiet_NaN()}));
}

TEST_F(PoseFiles, AnimatedNodesMoveMeshesAndInstances) {
  Bent gltf;
  gltf.document["nodes"][3].erase("skin");
  const int translations = gltf.accessor<float>({0, 0, 0, 5, 0, 0, 0, 5, 5}, 3);
  const int rotations =
      gltf.accessor<int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0, 23170, 0, 0, 23170}, 4);
  gltf.document["accessors"].back()["normalized"] = true;
  gltf.document["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", translations}, {"ROTATION", rotations}};
  gltf.animate("rotation", 0, 4, "LINEAR");
  const std::string path = put("a.glb", gltf.bytes());
  EXPECT_EQ(loadGltf(path).instances.size(), 3u);
  expectAgrees(path);
}

// Inverse transpose: normals stay at right angles to their triangle under an uneven scale.
TEST_F(PoseFiles, NormalsFollowTheSkin) {
  Bent gltf;
  gltf.primitive().erase("targets");
  gltf.document["meshes"][0].erase("weights");
  gltf.document["nodes"][0]["scale"] = {1, 3, 0.2};
  gltf.document["nodes"][0]["rotation"] = {0.5, 0.5, 0.5, 0.5};
  for (const bool mirror : {false, true}) {
    gltf.document["nodes"][1]["scale"] = {mirror ? -1 : 1, 1, 1};
    gltf.setWeights<uint8_t, float>(std::vector<uint8_t>(12, 0),
                                    {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
    const auto& p = scene.positions;
    for (const glm::vec3& normal : scene.normals) {
      EXPECT_NEAR(glm::dot(normal, glm::normalize(p[1] - p[0])), 0, 1e-5);
      EXPECT_NEAR(glm::dot(normal, glm::normalize(p[2] - p[0])), 0, 1e-5);
      EXPECT_NEAR(glm::length(normal), 1, 1e-6);
    }
  }
}

TEST_F(PoseFiles, BadRigsAreRefusedByTheirPlace) {
  const auto refused = [&](const json& patch, const std::string& place) {
    Bent gltf;
    gltf.animate("rotation", 1, 4, "LINEAR");
    gltf.document = gltf.document.patch(patch);
    SCOPED_TRACE(patch.dump());
    try {
      loadGltf(put("a.glb", gltf.bytes()));
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kSceneInvalid);
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  };
  const auto set = [](const char* path, const json& value) {
    return json::array({{{"op", "add"}, {"path", path}, {"value", value}}});
  };
  refused(set("/skins/0/joints", {1}), "meshes[0].primitives[0].attributes.JOINTS_0: joint 1");
  refused(set("/skins/0/joints", {1, 99}), "skins[0].joints[1]");
  refused(set("/nodes/3/skin", 7), "nodes[3].skin");
  refused(set("/skins/0/inverseBindMatrices", 0), "skins[0].inverseBindMatrices");
  refused(set("/meshes/0/primitives/0/attributes/JOINTS_0", 0),
          "meshes[0].primitives[0].attributes.JOINTS_0: ");
  refused(set("/meshes/0/primitives/0/attributes/WEIGHTS_0", 1), "attributes.WEIGHTS_0");
  refused(set("/meshes/0/weights", {1, 2, 3}), "meshes[0].weights");
  refused(set("/meshes/0/primitives/0/targets/1/POSITION", 2),
          "meshes[0].primitives[0].targets[1].POSITION: ");
  refused(set("/animations/0/channels/0/target/node", 44), "animations[0].channels[0]");
  refused(set("/animations/0/channels/0/sampler", 3), "animations[0].channels[0]");
  refused(set("/animations/0/samplers/0/output", 0), "animations[0].channels[0]");
  refused(set("/animations/0/samplers/0/interpolation", "SMOOTH"), "SMOOTH");
}

TEST_F(PoseFiles, ChannelsThatCannotMoveTheirNodeHaveANote) {
  Bent gltf;
  gltf.animate("translation", 2, 3, "LINEAR");
  gltf.animate("weights", 0, 2, "LINEAR");
  gltf.document["nodes"][2] = {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}}};
  gltf.document["animations"][0]["channels"].push_back(
      json::parse(R"({"sampler": 0, "target": {"path": "pointer"}})"));
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("animations[0]: 2 channels left out"), std::string::npos);
  EXPECT_TRUE(scene.rig->animations[0].channels.empty());
}

// Every value of a file with a rig is replaced by values of the wrong kind: the loader or pose()
// refuses it, or takes it.
TEST_F(PoseFiles, WrongValuesAnywhereDoNoHarm) {
  Bent gltf;
  gltf.animate("rotation", 1, 4, "CUBICSPLINE");
  gltf.animate("weights", 3, 2, "STEP");
  gltf.document["nodes"][2]["mesh"] = 0;
  gltf.document["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", 0}};
  ASSERT_NO_THROW(loadGltf(put("good.glb", gltf.bytes())));
  const json replacements[] = {nullptr, -1, 1, 1u << 31, 1e300, "x", json::array(), json::object()};
  const json flat = gltf.document.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    for (const json& replacement : replacements) {
      json bad = gltf.document;
      bad[json::json_pointer(pointer)] = replacement;
      SCOPED_TRACE(pointer + " = " + replacement.dump());
      try {
        Scene scene = loadGltf(put("a.glb", glb(bad, gltf.binary)));
        if (!scene.rig || scene.rig->animations.empty()) continue;
        pose(scene, {.animation = 0, .seconds = 0.7});
      } catch (const Error& error) {
        const int number = static_cast<int>(error.id());
        EXPECT_TRUE(number >= 2101 && number <= 2105) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace grisaille::scene
