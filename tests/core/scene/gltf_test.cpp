// SPDX-License-Identifier: MIT
// Meaning of valid glTF files. Writing a scene and loading it again loses nothing.
#include <cmath>

#include "core/image/image.h"
#include "tests/core/scene/gltf_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

using GltfFiles = SceneFiles;

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string png() {
  const auto bytes = image::encodePng({.width = 1, .height = 1, .pixels = {10, 20, 30, 40}});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(GltfFiles, BuffersMayBeFilesOrText) {
  Gltf gltf = Gltf::triangle();
  json& buffer = gltf.document["buffers"][0];
  buffer["byteLength"] = gltf.binary.size();
  buffer["uri"] = "data:application/octet-stream;base64," + base64(gltf.binary);
  EXPECT_EQ(triangleCount(loadGltf(put("text.gltf", gltf.document.dump()))), 1u);
  std::filesystem::create_directories(folder_ / "sub folder");
  put("sub folder/a.bin", gltf.binary);
  buffer["uri"] = "sub%20folder/a.bin";
  EXPECT_EQ(triangleCount(loadGltf(put("file.gltf", gltf.document.dump()))), 1u);
}

TEST_F(GltfFiles, PathsThatLeaveTheFolderAreRefused) {
  Gltf gltf = Gltf::triangle();
  put("a.bin", gltf.binary);
  std::filesystem::create_directories(folder_ / "deep");
  json& buffer = gltf.document["buffers"][0];
  buffer["byteLength"] = gltf.binary.size();
  for (const std::string& uri : {std::string("../a.bin"), file("a.bin"),
                                 std::string("x/../../a.bin"), std::string("%2e%2e/a.bin")}) {
    buffer["uri"] = uri;
    EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("deep/a.gltf", gltf.document.dump())));
  }
  for (const char* uri : {"missing.bin", ".", "http://example.org/a.bin"}) {
    buffer["uri"] = uri;
    EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(put("a.gltf", gltf.document.dump())));
  }
}

TEST_F(GltfFiles, NodesNestWithBothKindsOfTransform) {
  Gltf gltf = Gltf::triangle();
  const double h = std::sqrt(0.5);
  gltf.document["nodes"] = {
      {{"children", {1, 2}},
       {"translation", {10, 0, 0}},
       {"rotation", {0, 0, h, h}},
       {"scale", {2, 2, 2}}},
      {{"mesh", 0}, {"translation", {1, 0, 0}}},
      {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 5, 6, 7, 1}}}};
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.primitives.size(), 1u);  // shared by both nodes
  const auto at = [&](size_t instance, glm::dvec3 p) {
    return glm::dvec3(scene.instances[instance].worldFromObject * glm::dvec4(p, 1));
  };
  // A quarter turn about z, doubled, then moved: (x, y) -> (10 - 2 y, 2 x).
  EXPECT_LT(glm::distance(at(0, {0, 0, 0}), glm::dvec3(10, 2, 0)), 1e-12);
  EXPECT_LT(glm::distance(at(0, {1, 0, 0}), glm::dvec3(10, 4, 0)), 1e-12);
  EXPECT_LT(glm::distance(at(1, {0, 1, 0}), glm::dvec3(-2, 10, 12)), 1e-12);
  EXPECT_NEAR(scene.bounds.max.z, 14, 1e-12);
  EXPECT_NEAR(scene.bounds.min.x, -2, 1e-12);
}

TEST_F(GltfFiles, TheDefaultSceneIsShown) {
  Gltf gltf = Gltf::triangle();
  gltf.document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  gltf.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  gltf.document["scene"] = 1;
  EXPECT_EQ(loadGltf(put("a.glb", gltf.bytes())).bounds.max.x, 6);
  gltf.document.erase("scene");
  EXPECT_EQ(loadGltf(put("a.glb", gltf.bytes())).bounds.max.x, 1);
  gltf.document.erase("scenes");
  gltf.document["nodes"][0]["children"] = {1};
  EXPECT_EQ(loadGltf(put("a.glb", gltf.bytes())).instances.size(), 2u);
}

TEST_F(GltfFiles, ModesBecomeTriangles) {
  Gltf gltf;
  const int positions =
      gltf.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, 3);
  std::vector<float> up;
  for (int i = 0; i < 6; ++i) up.insert(up.end(), {0, 0, 1});
  gltf.primitive()["attributes"] = {{"POSITION", positions},
                                    {"NORMAL", gltf.accessor<float>(up, 3)}};
  const auto facing = [&](const Scene& scene) {
    for (size_t i = 0; i < scene.indices.size(); i += 3) {
      const auto p = [&](size_t k) { return scene.positions[scene.indices[i + k]]; };
      EXPECT_GT(glm::cross(p(1) - p(0), p(2) - p(0)).z, 0) << i;
    }
    return triangleCount(scene);
  };
  gltf.primitive()["mode"] = 5;
  EXPECT_EQ(facing(loadGltf(put("a.glb", gltf.bytes()))), 4u);
  gltf.primitive()["mode"] = 6;
  gltf.primitive()["indices"] = gltf.accessor<uint8_t>({0, 1, 3, 5, 4}, 1);
  EXPECT_EQ(facing(loadGltf(put("a.glb", gltf.bytes()))), 3u);
  gltf.primitive()["mode"] = 4;
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("a.glb", gltf.bytes())));  // 5 indices
  for (const int mode : {0, 1, 2, 3}) {
    gltf.primitive()["mode"] = mode;
    EXPECT_ERROR(ErrorId::kSceneEmpty, loadGltf(put("a.glb", gltf.bytes())));
  }
  gltf.primitive()["mode"] = 7;
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("a.glb", gltf.bytes())));
}

TEST_F(GltfFiles, MissingNormalsAreFlat) {
  Gltf gltf;
  const int positions = gltf.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
  const int texCoords = gltf.accessor<float>({0, 0, 1, 0, 0, 1, 1, 1}, 2);
  gltf.primitive() = {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", texCoords}}},
                      {"indices", gltf.accessor<uint16_t>({0, 2, 1, 0, 1, 3}, 1)}};
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.normals.size(), 6u);
  EXPECT_EQ(scene.texCoords[scene.indices[5]], glm::vec2(1, 1));
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(scene.normals[scene.indices[i]], i < 3 ? glm::vec3(0, 0, -1) : glm::vec3(0, -1, 0));
  }
}

TEST_F(GltfFiles, NormalsBecomeUnitAndThoseWithoutLengthAreRepaired) {
  Gltf gltf;
  const int positions = gltf.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}, 3);
  const int normals = gltf.accessor<float>({0, 0, 0, 0, 3, 4, 0, 0, 1e-3f, 0, 0, 0}, 3);
  gltf.primitive() = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                      {"indices", gltf.accessor<uint16_t>({0, 1, 2}, 1)}};
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  EXPECT_EQ(scene.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.normals[1], glm::vec3(0, 0.6f, 0.8f));
  for (const glm::vec3& normal : scene.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-6);
}

TEST_F(GltfFiles, MaterialsAndTextures) {
  Gltf gltf = Gltf::triangle();
  const std::string picture = png();
  gltf.document["images"] = {
      {{"bufferView", gltf.view(picture.data(), picture.size())}, {"mimeType", "image/png"}},
      {{"uri", "data:image/png;base64," + base64(picture)}},
      {{"uri", "not%20there.png"}},  // not a base colour: never read
      {{"uri", "a%20b.png"}}};
  put("a b.png", picture);
  gltf.document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  gltf.document["textures"] = {
      {{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 3}}};
  const auto textured = [](int index) -> json {
    return {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", index}}}}}};
  };
  gltf.document["materials"] = {textured(0), textured(1), textured(3), textured(1)};
  json& first = gltf.document["materials"][0];
  first["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 0.125, 1};
  first["normalTexture"] = {{"index", 2}};
  first["alphaMode"] = "MASK";
  first["alphaCutoff"] = 0.75;
  first["doubleSided"] = true;
  gltf.document["materials"][1]["alphaMode"] = "BLEND";
  gltf.document["materials"][1]["alphaCutoff"] = 0.9;
  gltf.primitive()["material"] = 0;
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.materials.size(), 4u);
  ASSERT_EQ(scene.textures.size(), 3u);
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 0.125f, 1));
  EXPECT_TRUE(material.masked && material.doubleSided);
  EXPECT_EQ(material.alphaCutoff, 0.75f);
  EXPECT_TRUE(scene.materials[1].masked);
  EXPECT_EQ(scene.materials[1].alphaCutoff, 0.5f);
  EXPECT_EQ(scene.materials[3].baseColorTexture, scene.materials[1].baseColorTexture);
  EXPECT_EQ(scene.textures[0].wrapU, Wrap::kClamp);
  EXPECT_EQ(scene.textures[0].wrapV, Wrap::kMirror);
  EXPECT_EQ(scene.textures[1].wrapU, Wrap::kRepeat);
  for (const Texture& texture : scene.textures) {
    EXPECT_EQ(texelsOf(texture).pixels, (std::vector<uint8_t>{10, 20, 30, 40}));
  }
}

TEST_F(GltfFiles, BadMaterialsAreRefused) {
  const auto refused = [&](const json& patch) {
    Gltf gltf = Gltf::triangle();
    gltf.document["materials"] = json::array(
        {json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})")});
    gltf.document["textures"] = json::array({json::object({{"source", 0}})});
    gltf.document["images"] =
        json::array({json::object({{"uri", "data:image/png;base64," + base64(png())}})});
    gltf.document.merge_patch(patch);
    SCOPED_TRACE(patch.dump());
    EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("a.glb", gltf.bytes())));
  };
  for (const char* patch :
       {R"({"textures": [{"source": 9}]})", R"({"textures": []})",
        R"({"textures": [{"source": 0, "sampler": 3}]})",
        R"({"textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 1}]})",
        R"({"materials": [{"alphaMode": "GLASS"}]})",
        R"({"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 2]}}]})",
        R"({"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": -7}}}]})",
        R"({"materials": [{"pbrMetallicRoughness": {"baseColorTexture":
            {"index": 0, "texCoord": -1}}}]})",
        R"({"images": [{"bufferView": 0}], "bufferViews": [{"buffer": 0, "byteOffset": 4000000000,
            "byteLength": 4000000000}]})"}) {
    refused(json::parse(patch));
  }
  refused(json::parse(R"({"images": [{"uri": "../a.png"}]})"));
}

TEST_F(GltfFiles, TheTexturesSetAndTransformAreApplied) {
  Gltf gltf = Gltf::triangle();
  const std::vector<float> first{9, 9, 9, 9, 9, 9}, second{0, 0, 1, 0, 0, 1};
  gltf.primitive()["attributes"]["TEXCOORD_0"] = gltf.accessor(first, 2);
  gltf.primitive()["attributes"]["TEXCOORD_1"] = gltf.accessor(second, 2);
  gltf.primitive()["material"] = 0;
  gltf.document["images"] =
      json::array({json::object({{"uri", "data:image/png;base64," + base64(png())}})});
  gltf.document["textures"] = json::array({json::object({{"source", 0}})});
  gltf.document["extensionsRequired"] = {"KHR_texture_transform"};
  gltf.document["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture":
      {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
          {"texCoord": 1, "offset": [0.5, 0.25], "scale": [2, 4],
           "rotation": 1.5707963267948966}}}}}])");
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  // Scale, then turn by 90 degrees counter-clockwise with v down: (u, v) -> (v, -u), then move.
  const glm::vec2 expected[] = {{0.5f, 0.25f}, {0.5f, -1.75f}, {4.5f, 0.25f}};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(scene.texCoords[i], expected[i]), 1e-6f) << i;
  }
}

TEST_F(GltfFiles, WritingLosesNothing) {
  for (const bool builtIn : {true, false}) {
    Scene scene = makeAtrium();
    if (!builtIn) {
      scene.materials[2].name = "odd \xff name\n";
      scene.textures[0] = {.name = "leaf",
                           .encoded = image::encodePng(scene.textures[0].texels),
                           .texels = {},
                           .wrapU = Wrap::kMirror};
      scene.instances[3].worldFromObject[3] = {1.0 / 3, 1e-17, 1e8, 1};
      computeBounds(scene);
    }
    writeGlb(scene, file("a.glb"));
    const Scene back = loadGltf(file("a.glb"));
    EXPECT_EQ(back.positions, scene.positions);
    EXPECT_EQ(back.normals.size(), scene.normals.size());
    for (size_t i = 0; i < scene.normals.size(); ++i) {
      // Loading normalises the vectors again.
      ASSERT_LT(glm::distance(back.normals[i], scene.normals[i]), 2e-7f);
    }
    EXPECT_EQ(back.texCoords, scene.texCoords);
    EXPECT_EQ(back.indices, scene.indices);
    EXPECT_EQ(back.bounds.min, scene.bounds.min);
    EXPECT_EQ(back.bounds.max, scene.bounds.max);
    ASSERT_EQ(back.instances.size(), scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
      EXPECT_EQ(back.instances[i].primitive, scene.instances[i].primitive);
      EXPECT_EQ(scene.instances[i].worldFromObject, back.instances[i].worldFromObject);
    }
    ASSERT_EQ(back.primitives.size(), scene.primitives.size());
    for (size_t i = 0; i < scene.primitives.size(); ++i) {
      EXPECT_EQ(back.primitives[i].firstIndex, scene.primitives[i].firstIndex);
      EXPECT_EQ(back.primitives[i].indexCount, scene.primitives[i].indexCount);
      EXPECT_EQ(back.primitives[i].material, scene.primitives[i].material);
    }
    ASSERT_EQ(back.materials.size(), scene.materials.size());
    for (size_t i = 0; i < scene.materials.size(); ++i) {
      EXPECT_EQ(back.materials[i].baseColor, scene.materials[i].baseColor);
      EXPECT_EQ(back.materials[i].masked, scene.materials[i].masked);
      EXPECT_EQ(back.materials[i].doubleSided, scene.materials[i].doubleSided);
      EXPECT_EQ(back.materials[i].baseColorTexture, scene.materials[i].baseColorTexture);
    }
    ASSERT_EQ(back.textures.size(), scene.textures.size());
    EXPECT_EQ(texelsOf(back.textures[0]).pixels, texelsOf(scene.textures[0]).pixels);
    if (!builtIn) {
      EXPECT_EQ(back.textures[0].encoded, scene.textures[0].encoded);
    }
    EXPECT_EQ(back.textures[0].wrapU, scene.textures[0].wrapU);
  }
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeGlb(makeAtrium(), file("missing/a.glb")));
  EXPECT_ERROR(ErrorId::kSceneEmpty, writeGlb(Scene{}, file("b.glb")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

}  // namespace
}  // namespace grisaille::scene
