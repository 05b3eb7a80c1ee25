// SPDX-License-Identifier: MIT
// Files that are broken by accident or on purpose: each ends in one error, never a crash or a hang.
#include <sys/stat.h>

#include <chrono>
#include <random>

#include "tests/core/scene/gltf_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

using HostileFiles = SceneFiles;

TEST_F(HostileFiles, WhatIsNoGltf) {
  EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(file("missing.glb")));
  EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(file("")));
  mkfifo(file("pipe.glb").c_str(), 0600);
  EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(file("pipe.glb")));
  for (const char* text :
       {"", "g", "glTF", "{", "[]", "{}", "12", "null", "not JSON at all", R"({"asset": {}})",
        R"({"asset": {"version": 2}})", R"({"asset": 3})", R"({"asset": {"version": "1.0"}})",
        R"({"asset": {"version": "2.1", "minVersion": "2.1"}})",
        "{\"asset\": {\"version\": \"2.0\xff\"}}"}) {
    SCOPED_TRACE(text);
    EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(put("a.gltf", text)));
  }
  std::string bytes = Gltf::triangle().bytes();
  bytes[4] = 1;
  EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(put("one.glb", bytes)));
  EXPECT_ERROR(ErrorId::kSceneEmpty, loadGltf(put("a.gltf", R"({"asset": {"version": "2.0"}})")));
}

TEST_F(HostileFiles, RequiredExtensionsAreRefusedByName) {
  Gltf gltf = Gltf::triangle();
  gltf.document["extensionsUsed"] = {"KHR_made_up"};
  EXPECT_NO_THROW(loadGltf(put("a.glb", gltf.bytes())));
  gltf.document["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_made_up"};
  try {
    loadGltf(put("a.glb", gltf.bytes()));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kSceneExtension);
    EXPECT_NE(error.detail().find("KHR_made_up"), std::string::npos);
  }
}

TEST_F(HostileFiles, NodesThatAreNoTree) {
  const auto refused = [&](const char* nodes, const char* roots) {
    Gltf gltf = Gltf::triangle();
    gltf.document["nodes"] = json::parse(nodes);
    gltf.document["scenes"][0]["nodes"] = json::parse(roots);
    SCOPED_TRACE(nodes);
    EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("a.glb", gltf.bytes())));
  };
  refused(R"([{"mesh": 0, "children": [0]}])", "[0]");
  refused(R"([{"children": [1]}, {"children": [2]}, {"mesh": 0, "children": [1]}])", "[0]");
  refused(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])", "[0, 1]");
  refused(R"([{"mesh": 0}])", "[0, 0]");
  refused(R"([{"mesh": 0, "children": [7]}])", "[0]");
  refused(R"([{"mesh": 0}])", "[-1]");
  refused(R"([{"mesh": 1}])", "[0]");
  refused(R"([{"mesh": -5}])", "[0]");
  refused(R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])", "[0]");
  refused(R"([{"mesh": 0, "scale": [1e308, 1, 1], "children": [1]},
              {"mesh": 0, "scale": [1e308, 1, 1]}])",
          "[0]");
  refused(R"([{"mesh": 0, "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])", "[0]");
  Gltf gltf = Gltf::triangle();
  gltf.document["scene"] = 4;
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("a.glb", gltf.bytes())));
}

TEST_F(HostileFiles, AChainOfNodesMayBeLong) {
  constexpr int kNodes = 100000;
  Gltf gltf = Gltf::triangle();
  json nodes = json::array();
  for (int i = 1; i < kNodes; ++i) nodes.push_back(json::object({{"children", json::array({i})}}));
  nodes.push_back(json::object({{"mesh", 0}}));
  gltf.document["nodes"] = nodes;
  EXPECT_EQ(loadGltf(put("a.glb", gltf.bytes())).instances.size(), 1u);
}

TEST_F(HostileFiles, JsonMayNotNestDeep) {
  const std::string deep = R"({"asset": {"version": "2.0"}, "extras": )" +
                           std::string(200000, '[') + std::string(200000, ']') + "}";
  EXPECT_ERROR(ErrorId::kSceneTooLarge, loadGltf(put("a.gltf", deep)));
}

TEST_F(HostileFiles, TheBinaryChunkIsNotMultiplied) {
  Gltf gltf = Gltf::triangle();
  gltf.binary.resize(1 << 20);
  const std::string one = gltf.bytes();
  for (int i = 0; i < 10000; ++i) {
    gltf.document["buffers"].push_back(json::object({{"byteLength", 1 << 20}}));
  }
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("a.glb", gltf.bytes())));
}

TEST_F(HostileFiles, SharedVerticesAreNotMultiplied) {
  // Many primitives share 3 million vertices that take no bytes in the file.
  Gltf gltf = Gltf::triangle();
  for (json& accessor : gltf.document["accessors"]) {
    accessor.erase("bufferView");
    accessor["count"] = 3000000;
  }
  json& primitives = gltf.document["meshes"][0]["primitives"];
  primitives[0]["indices"] = gltf.accessor<uint8_t>({0, 1, 2}, 1);
  const json one = primitives[0];
  for (int i = 0; i < 200; ++i) primitives.push_back(one);
  EXPECT_EQ(loadGltf(put("a.glb", gltf.bytes())).positions.size(), 3000000u);
}

TEST_F(HostileFiles, FewBytesMakeNoHugeScene) {
  Gltf gltf = Gltf::triangle();
  gltf.document["accessors"][0].erase("bufferView");
  gltf.document["accessors"][0]["count"] = 60000000;
  gltf.primitive()["attributes"].erase("NORMAL");
  EXPECT_ERROR(ErrorId::kSceneTooLarge, loadGltf(put("a.glb", gltf.bytes())));
}

TEST_F(HostileFiles, TextureTransformsStayWithinNumbers) {
  Gltf gltf = Gltf::triangle();
  gltf.primitive()["attributes"]["TEXCOORD_0"] = gltf.accessor<uint8_t>({0, 0, 255, 0, 0, 255}, 2);
  gltf.primitive()["material"] = 0;
  gltf.document["images"] = json::parse(R"([{"uri": "data:image/png;base64,AAAA"}])");
  gltf.document["textures"] = json::parse(R"([{"source": 0}])");
  const auto scaled = [&](double scale) {
    json transform;
    transform["KHR_texture_transform"]["scale"] = json::array({scale, 1});
    json material;
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0},
                                                            {"extensions", transform}};
    gltf.document["materials"] = json::array({material});
    return put("a.glb", gltf.bytes());
  };
  EXPECT_NO_THROW(loadGltf(scaled(1e30)));
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(scaled(1e300)));
}

// Loads bytes that are probably broken; any exception but an Error fails the test.
void loadBroken(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  try {
    loadGltf(path);
  } catch (const Error& error) {
    const int number = static_cast<int>(error.id());
    EXPECT_TRUE(number >= 2101 && number <= 2106) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

// A file with most of the supported features: textures, masks, sparse accessors, a node tree,
// strips.
std::string richFile() {
  Gltf gltf = Gltf::triangle();
  gltf.primitive()["indices"] = gltf.accessor<uint16_t>({0, 1, 2}, 1);
  const std::vector<uint8_t> where{1};
  const std::vector<float> what{2, 0, 0};
  gltf.document["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", gltf.view(where.data(), 1)}, {"componentType", 5121}}},
      {"values", {{"bufferView", gltf.view(what.data(), 12)}}}};
  json strip = gltf.primitive();
  strip["mode"] = 5;
  strip["attributes"].erase("NORMAL");
  strip["attributes"]["TEXCOORD_0"] = gltf.accessor<uint8_t>({0, 0, 255, 0, 0, 255}, 2);
  gltf.document["meshes"][0]["primitives"].push_back(strip);
  gltf.document["nodes"] = json::parse(
      R"([{"mesh": 0, "children": [1], "translation": [1, 2, 3]}, {"mesh": 0, "scale": [1, 2, 1]}])");
  const std::string picture = "\x89PNG\r\n\x1a\n not really";
  gltf.document["images"] = {
      {{"bufferView", gltf.view(picture.data(), picture.size())}, {"mimeType", "image/png"}},
      {{"uri", "data:image/png;base64,AAAA"}}};
  gltf.document["textures"] = json::parse(R"([{"source": 0, "sampler": 0}, {"source": 1}])");
  gltf.document["samplers"] = json::parse(R"([{"wrapS": 33071}])");
  gltf.document["materials"] = json::parse(R"([{"alphaMode": "MASK", "extras": {"a": [1, {"b": 2}]},
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
      {"KHR_texture_transform": {"offset": [0, 1], "scale": [2, 2]}}}}}])");
  gltf.document["extensionsUsed"] = {"KHR_texture_transform"};
  strip["material"] = 0;
  gltf.document["meshes"][0]["primitives"].push_back(strip);
  return gltf.bytes();
}

TEST_F(HostileFiles, CutShortAnywhere) {
  const std::string good = richFile();
  ASSERT_NO_THROW(loadGltf(put("good.glb", good)));
  for (size_t size = 0; size < good.size(); size += 13) {
    EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(put("a.glb", good.substr(0, size))));
    // The same, with a header that states the reduced length.
    std::string cut = good.substr(0, size);
    if (size < 12) continue;
    const auto length = static_cast<uint32_t>(size);
    std::memcpy(&cut[8], &length, 4);
    loadBroken(put("a.glb", cut));
  }
}

TEST_F(HostileFiles, BytesFlippedAnywhere) {
  const std::string good = richFile();
  std::mt19937 random(2101);
  for (int i = 0; i < 1200; ++i) {
    std::string bad = good;
    const uint32_t flips = 1 + random() % 4;
    for (uint32_t k = 0; k < flips; ++k) {
      // Replacing digits by digits keeps the JSON valid; the damage reaches later stages.
      char& at = bad[12 + random() % (bad.size() - 12)];
      const bool digit = at >= '0' && at <= '9';
      at = static_cast<char>(digit               ? '0' + random() % 10
                             : random() % 4 == 0 ? random() % 256
                                                 : static_cast<uint8_t>(at));
    }
    SCOPED_TRACE(i);
    loadBroken(put("a.glb", bad));
  }
}

TEST_F(HostileFiles, ValuesOfTheWrongKindAnywhere) {
  const std::string good = richFile();
  uint32_t length = 0;
  std::memcpy(&length, &good[12], 4);
  const json document = json::parse(good.substr(20, length));
  const std::string binary = good.substr(28 + length);
  const json flat = document.flatten();
  const json replacements[] = {
      nullptr, -1, 1u << 31, ~uint64_t{0}, 1e300, "x", json::array(), json::object(), true};
  for (const auto& [pointer, value] : flat.items()) {
    for (const json& replacement : replacements) {
      json bad = document;
      bad[json::json_pointer(pointer)] = replacement;
      SCOPED_TRACE(pointer + " = " + replacement.dump());
      loadBroken(put("a.glb", glb(bad, binary)));
    }
  }
}

TEST_F(HostileFiles, RandomBytes) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    std::string bytes(1 + random() % 300, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(put("a.gltf", bytes)));
    EXPECT_ERROR(ErrorId::kSceneUnreadable, loadGltf(put("a.glb", "glTF" + bytes)));
  }
}

}  // namespace
}  // namespace grisaille::scene
