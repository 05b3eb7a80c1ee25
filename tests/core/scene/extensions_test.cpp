// SPDX-License-Identifier: MIT
// Extensions of glTF, compressed geometry, notes, and textures that cannot be read.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include "core/base/note.h"
#include "core/image/image.h"
#include "tests/core/scene/gltf_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

using ExtensionFiles = SceneFiles;

// A grid of triangles with normals.
Gltf grid(std::vector<float>& positions, std::vector<uint32_t>& indices) {
  constexpr uint32_t kSide = 6;
  std::vector<float> normals;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    const auto x = static_cast<float>(i % kSide), y = static_cast<float>(i / kSide);
    positions.insert(positions.end(), {x, y, 0.1f * x * y});
    normals.insert(normals.end(), {0, 0, 1});
  }
  for (uint32_t y = 0; y + 1 < kSide; ++y) {
    for (uint32_t x = 0; x + 1 < kSide; ++x) {
      const uint32_t a = y * kSide + x;
      indices.insert(indices.end(), {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide});
    }
  }
  Gltf gltf;
  const int p = gltf.accessor(positions, 3), n = gltf.accessor(normals, 3);
  gltf.primitive() = {{"attributes", {{"POSITION", p}, {"NORMAL", n}}},
                      {"indices", gltf.accessor(indices, 1)}};
  return gltf;
}

glm::vec3 centroid(const Scene& scene, size_t triangle) {
  glm::vec3 sum(0);
  for (size_t k = 0; k < 3; ++k) sum += scene.positions[scene.indices[3 * triangle + k]];
  return sum / 3.0f;
}

// The triangles' centres, in an order that does not depend on the file's.
std::vector<glm::vec3> centroids(const Scene& scene) {
  std::vector<glm::vec3> all;
  for (size_t i = 0; i < scene.indices.size() / 3; ++i) all.push_back(centroid(scene, i));
  std::ranges::sort(all, [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  });
  return all;
}

std::string dracoBytes(const std::vector<float>& positions, const std::vector<uint32_t>& indices,
                       int speed) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(indices.size() / 3));
  const int p = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int n = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  const float up[] = {0, 0, 1};
  for (uint32_t i = 0; i < indices.size(); i += 3) {
    const draco::FaceIndex face(i / 3);
    builder.SetAttributeValuesForFace(p, face, &positions[3 * indices[i]],
                                      &positions[3 * indices[i + 1]],
                                      &positions[3 * indices[i + 2]]);
    builder.SetAttributeValuesForFace(n, face, up, up, up);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

TEST_F(ExtensionFiles, DracoIsDecoded) {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
  Gltf gltf = grid(positions, indices);
  const auto expected = centroids(loadGltf(put("plain.glb", gltf.bytes())));
  for (const int speed : {0, 5, 10}) {  // edgebreaker, and sequential at 10
    const std::string bytes = dracoBytes(positions, indices, speed);
    Gltf compressed = gltf;
    compressed.binary.clear();
    compressed.document["bufferViews"] = json::array();
    const int view = compressed.view(bytes.data(), bytes.size());
    for (json& accessor : compressed.document["accessors"]) accessor.erase("bufferView");
    compressed.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
    for (const bool required : {false, true}) {
      compressed.document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
      if (required) compressed.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
      const Scene scene = loadGltf(put("a.glb", compressed.bytes()));
      EXPECT_TRUE(scene.notes.empty());
      const auto found = centroids(scene);
      ASSERT_EQ(found.size(), expected.size());
      for (size_t i = 0; i < found.size(); ++i) {
        EXPECT_LT(glm::distance(found[i], expected[i]), 1e-3f) << speed;
      }
    }
    // Sizes that differ from the accessors', and bytes that are cut off or flipped.
    const auto refused = [&](Gltf& bad) {
      EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(put("bad.glb", bad.bytes())));
    };
    for (const int index : {0, 2}) {
      Gltf bad = compressed;
      bad.document["accessors"][index]["count"] = 30;
      refused(bad);
    }
    Gltf cut = compressed;
    cut.document["bufferViews"][view]["byteLength"] = bytes.size() / 2;
    refused(cut);
    for (size_t i = 0; i < bytes.size(); i += 3) {
      Gltf flipped = compressed;
      flipped.binary[i] = static_cast<char>(flipped.binary[i] ^ 0x55);
      try {
        loadGltf(put("flipped.glb", flipped.bytes()));
      } catch (const Error& error) {
        EXPECT_EQ(error.id(), ErrorId::kSceneInvalid) << error.what();
      }
    }
  }
}

TEST_F(ExtensionFiles, MeshoptIsDecoded) {
  std::vector<float> positions;
  std::vector<uint32_t> indices;
  Gltf gltf = grid(positions, indices);
  const auto expected = centroids(loadGltf(put("plain.glb", gltf.bytes())));
  const auto compress = [&](Gltf& to, size_t view, const std::string& mode, size_t count,
                            size_t stride, const std::vector<unsigned char>& bytes) {
    json extension = {{"buffer", 0},          {"byteOffset", to.binary.size()},
                      {"count", count},       {"byteLength", bytes.size()},
                      {"byteStride", stride}, {"mode", mode}};
    to.binary.append(bytes.begin(), bytes.end());
    to.binary.resize((to.binary.size() + 3) / 4 * 4, '\0');
    json& entry = to.document["bufferViews"][view];
    entry["buffer"] = 1;
    entry["extensions"]["EXT_meshopt_compression"] = extension;
  };
  for (const bool sequence : {false, true}) {
    Gltf to = gltf;
    to.binary.clear();
    to.document["buffers"].push_back(json::parse(
        R"({"byteLength": 100000, "extensions": {"EXT_meshopt_compression": {"fallback": true}}})"));
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(positions.size() / 3, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), positions.data(),
                                            positions.size() / 3, 12));
    compress(to, 0, "ATTRIBUTES", positions.size() / 3, 12, bytes);
    std::vector<float> normals;
    for (size_t i = 0; i < positions.size() / 3; ++i) normals.insert(normals.end(), {0, 0, 1});
    bytes.assign(meshopt_encodeVertexBufferBound(normals.size() / 3, 12), 0);
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), normals.data(),
                                            normals.size() / 3, 12));
    compress(to, 1, "ATTRIBUTES", normals.size() / 3, 12, bytes);
    bytes.assign(sequence ? meshopt_encodeIndexSequenceBound(indices.size(), 36)
                          : meshopt_encodeIndexBufferBound(indices.size(), 36),
                 0);
    const uint32_t* first = indices.data();
    bytes.resize(
        sequence ? meshopt_encodeIndexSequence(bytes.data(), bytes.size(), first, indices.size())
                 : meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), first, indices.size()));
    compress(to, 2, sequence ? "INDICES" : "TRIANGLES", indices.size(), 4, bytes);
    to.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    const auto found = centroids(loadGltf(put("a.glb", to.bytes())));
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
      EXPECT_LT(glm::distance(found[i], expected[i]), 1e-6f);
    }
    const auto refused = [&](const char* key, const json& value, ErrorId id) {
      Gltf bad = to;
      bad.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
      EXPECT_ERROR(id, loadGltf(put("bad.glb", bad.bytes())));
    };
    refused("mode", "SQUARES", ErrorId::kSceneInvalid);
    refused("filter", "BLUR", ErrorId::kSceneInvalid);
    refused("byteStride", 13, ErrorId::kSceneInvalid);
    refused("count", 35000000, ErrorId::kSceneInvalid);
    refused("count", 2000000000, ErrorId::kSceneTooLarge);
    refused("count", -1, ErrorId::kSceneInvalid);
    refused("byteLength", 7, ErrorId::kSceneInvalid);
    refused("byteLength", 100000, ErrorId::kSceneInvalid);
    refused("buffer", 5, ErrorId::kSceneInvalid);
  }
}

TEST_F(ExtensionFiles, ColoursOfEveryTypeAreRead) {
  const auto coloursOf = [&](auto&& add) {
    Gltf gltf = Gltf::triangle();
    gltf.primitive()["attributes"]["COLOR_0"] = add(gltf);
    return loadGltf(put("a.glb", gltf.bytes())).colours;
  };
  const std::vector<glm::vec4> rgba{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 1}};
  EXPECT_EQ(coloursOf([](Gltf& g) {
              return g.accessor<float>({1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 1}, 4);
            }),
            rgba);
  EXPECT_EQ(
      coloursOf([](Gltf& g) {
        const int index = g.accessor<uint8_t>({255, 0, 0, 255, 0, 255, 0, 0, 0, 0, 255, 255}, 4);
        g.document["accessors"][index]["normalized"] = true;
        return index;
      }),
      rgba);
  const std::vector<glm::vec4> rgb{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  EXPECT_EQ(coloursOf([](Gltf& g) {
              const int index = g.accessor<uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 65535}, 3);
              g.document["accessors"][index]["normalized"] = true;
              return index;
            }),
            rgb);
  // Other primitives of the file are white.
  Gltf gltf = Gltf::triangle();
  json second = gltf.primitive();
  second["attributes"]["COLOR_0"] = gltf.accessor<float>({1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 1}, 4);
  gltf.document["meshes"][0]["primitives"].push_back(second);
  Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.colours.size(), 6u);
  EXPECT_FALSE(scene.primitives[0].coloured);
  EXPECT_TRUE(scene.primitives[1].coloured);
  EXPECT_EQ(scene.colours[0], glm::vec4(1));
  writeGlb(scene, file("written.glb"));
  EXPECT_EQ(loadGltf(file("written.glb")).colours, scene.colours);
}

TEST_F(ExtensionFiles, WhatIsLeftOutHasANote) {
  Gltf gltf = Gltf::triangle();
  gltf.document["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_unlit", "XYZ_optional",
                                     "KHR_texture_transform"};
  gltf.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_xmp_json_ld"};
  gltf.document["materials"] = {{{"alphaMode", "BLEND"}}, {{"alphaMode", "OPAQUE"}}};
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.notes.size(), 2u);
  EXPECT_EQ(scene.notes[0],
            "left out: KHR_lights_punctual, KHR_materials_unlit, KHR_xmp_json_ld, XYZ_optional");
  EXPECT_NE(scene.notes[1].find("1 of 2 materials blend"), std::string::npos);
  std::vector<std::string> lines;
  setNoteListener([&](const std::string& line) { lines.push_back(line); });
  loadScene(file("a.glb"));
  loadScene(file("a.glb"));
  setNoteListener({});
  ASSERT_EQ(lines.size(), 2u);  // each once
  EXPECT_NE(lines[0].find("a.glb: left out"), std::string::npos);
}

TEST_F(ExtensionFiles, SpecularGlossinessHasTheBaseColour) {
  Gltf gltf = Gltf::triangle();
  gltf.document["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  const auto picture = image::encodePng({.width = 1, .height = 1, .pixels = {1, 2, 3, 255}});
  gltf.document["images"] = {
      {{"bufferView", gltf.view(picture.data(), picture.size())}, {"mimeType", "image/png"}}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["materials"] = json::parse(R"([{"extensions": {
      "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.5, 0.25, 1, 0.75],
      "diffuseTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}}}}])");
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(0.5f, 0.25f, 1, 0.75f));
  EXPECT_EQ(scene.materials[0].baseColorTexture, 0);
  EXPECT_TRUE(scene.notes.empty());
}

TEST_F(ExtensionFiles, UnreadableTexturesAreWhiteWithANote) {
  Gltf gltf = Gltf::triangle();
  const std::string broken = "\x89PNG\r\n\x1a\n and no more";
  gltf.document["images"] = {
      {{"uri", "missing.png"}},
      {{"bufferView", gltf.view(broken.data(), broken.size())}, {"mimeType", "image/png"}}};
  gltf.document["textures"] = json::parse(R"([{"source": 0}, {}, {"source": 1}])");
  gltf.document["materials"] = json::parse(R"([
      {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
      {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}},
      {"pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}])");
  const Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.notes.size(), 2u);
  EXPECT_NE(scene.notes[0].find("images[0]: file \"missing.png\""), std::string::npos)
      << scene.notes[0];
  EXPECT_NE(scene.notes[1].find("textures[1]"), std::string::npos);
  EXPECT_EQ(scene.materials[0].baseColorTexture, -1);
  ASSERT_EQ(scene.textures.size(), 1u);
  std::vector<std::string> lines;
  setNoteListener([&](const std::string& line) { lines.push_back(line); });
  EXPECT_EQ(texelsOf(scene.textures[0]).pixels, std::vector<uint8_t>(4, 255));
  EXPECT_EQ(alphaOf(scene.textures[0]).pixels, std::vector<uint8_t>(1, 255));
  setNoteListener({});
  EXPECT_EQ(lines.size(), 1u);
}

TEST_F(ExtensionFiles, WebpIsDecoded) {
  // One transparent pixel, without loss.
  const std::string webp(
      "RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\0\0\0\x10\x07\x10\x11\x11\x88\x88\xfe\x07\0", 34);
  Gltf gltf = Gltf::triangle();
  gltf.document["extensionsRequired"] = {"EXT_texture_webp"};
  gltf.document["images"] = {
      {{"bufferView", gltf.view(webp.data(), webp.size())}, {"mimeType", "image/webp"}}};
  gltf.document["textures"] =
      json::parse(R"([{"extensions": {"EXT_texture_webp": {"source": 0}}}])");
  gltf.document["materials"] =
      json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  Scene scene = loadGltf(put("a.glb", gltf.bytes()));
  ASSERT_EQ(scene.textures.size(), 1u);
  std::vector<std::string> lines;
  setNoteListener([&](const std::string& line) { lines.push_back(line); });
  const image::Image8 texels = texelsOf(scene.textures[0]);
  setNoteListener({});
  EXPECT_TRUE(lines.empty()) << lines[0];
  ASSERT_EQ(texels.pixels.size(), 4u);
  EXPECT_EQ(texels.pixels[3], 0);
  writeGlb(scene, file("written.glb"));
  EXPECT_EQ(loadGltf(file("written.glb")).textures[0].encoded, scene.textures[0].encoded);
}

TEST_F(ExtensionFiles, IndicesMayHaveNoBufferView) {
  Gltf gltf = Gltf::triangle();
  gltf.document["accessors"].push_back({{"componentType", 5125}, {"count", 3}, {"type", "SCALAR"}});
  gltf.primitive()["indices"] = gltf.document["accessors"].size() - 1;
  EXPECT_EQ(loadGltf(put("a.glb", gltf.bytes())).indices, std::vector<uint32_t>(3, 0));
}

}  // namespace
}  // namespace grisaille::scene
