// SPDX-License-Identifier: MIT
// Small glTF files for tests, in a folder that is deleted after the test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace grisaille::scene {

using nlohmann::json;

class SceneFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("grisaille_scene_" + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::string put(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }

  std::filesystem::path folder_;
};

inline std::string glb(const json& document, const std::string& binary) {
  const auto word = [](size_t value) {
    const auto narrow = static_cast<uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&narrow), 4);
  };
  std::string text = document.dump(), data = binary;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  std::string chunks = word(text.size()) + "JSON" + text;
  if (!data.empty()) chunks += word(data.size()) + std::string("BIN\0", 4) + data;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

// A document with one mesh; the test adds the accessors.
struct Gltf {
  json document = json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {}}]}], "bufferViews": [], "accessors": [],
    "buffers": [{}]})");
  std::string binary;

  json& primitive() { return document["meshes"][0]["primitives"][0]; }

  // Appends bytes to the buffer. Returns the index of the buffer view.
  int view(const void* bytes, size_t size, size_t stride = 0) {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    json entry{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}};
    if (stride != 0) entry["byteStride"] = stride;
    binary.append(static_cast<const char*>(bytes), size);
    document["bufferViews"].push_back(entry);
    return static_cast<int>(document["bufferViews"].size()) - 1;
  }

  // Stores values. `components`: numbers per element. Returns the index of the accessor.
  template <typename T>
  int accessor(const std::vector<T>& values, size_t components) {
    constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    document["accessors"].push_back({{"bufferView", view(values.data(), values.size() * sizeof(T))},
                                     {"componentType", componentType<T>()},
                                     {"count", values.size() / components},
                                     {"type", kTypes[components - 1]}});
    return static_cast<int>(document["accessors"].size()) - 1;
  }

  template <typename T>
  static int componentType() {
    if (std::is_same_v<T, int8_t>) return 5120;
    if (std::is_same_v<T, uint8_t>) return 5121;
    if (std::is_same_v<T, int16_t>) return 5122;
    if (std::is_same_v<T, uint16_t>) return 5123;
    if (std::is_same_v<T, uint32_t>) return 5125;
    return 5126;
  }

  std::string bytes() {
    document["buffers"][0]["byteLength"] = binary.size();
    return glb(document, binary);
  }

  // One triangle in the plane z = 0 that faces +z, with normals along +z and no indices.
  static Gltf triangle() {
    Gltf gltf;
    const int positions = gltf.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    const int normals = gltf.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    gltf.primitive()["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}};
    return gltf;
  }
};

}  // namespace grisaille::scene
