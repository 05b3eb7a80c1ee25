// SPDX-License-Identifier: MIT
// Scenes: a .gltf or .glb file; or JSON, a zero byte and a binary chunk. From the latter the target
// builds a .glb with correct lengths, which a fuzzer would rarely find.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/scene/rig.h"
#include "tests/fuzz/fuzz.h"

namespace grisaille::fuzz {
namespace {

void append(std::string& bytes, size_t word) {
  const auto little = static_cast<uint32_t>(word);
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(little >> (8 * i) & 0xff));
}

std::string fileOf(std::string_view input) {
  const size_t end = input.find('\0');
  if (input.starts_with("glTF") || end == std::string_view::npos) return std::string(input);
  std::string json(cut(input, '\0')), binary(input);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append(bytes, 2);
  append(bytes, 28 + json.size() + binary.size());
  append(bytes, json.size());
  bytes += "JSON" + json;
  append(bytes, binary.size());
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

template <typename Vectors>
void requireFinite(const Vectors& vectors) {
  for (const auto& vector : vectors) {
    for (int i = 0; i < vector.length(); ++i) require(std::isfinite(vector[i]));
  }
}

void requireSound(const scene::Scene& scene) {
  const size_t count = scene.positions.size();
  require(scene.normals.size() == count && scene.texCoords.size() == count);
  require(scene.colours.empty() || scene.colours.size() == count);
  requireFinite(scene.colours);
  requireFinite(scene.positions);
  requireFinite(scene.normals);
  requireFinite(scene.texCoords);
  for (const uint32_t index : scene.indices) require(index < count);
  for (const scene::Primitive& primitive : scene.primitives) {
    require(primitive.indexCount > 0 && primitive.indexCount % 3 == 0);
    require(size_t{primitive.firstIndex} + primitive.indexCount <= scene.indices.size());
    require(primitive.material < scene.materials.size());
    require(!primitive.coloured || !scene.colours.empty());
  }
  for (const scene::Material& material : scene.materials) {
    requireFinite(std::initializer_list<glm::vec4>{material.baseColor});
    require(material.baseColorTexture >= -1);
    require(material.baseColorTexture < static_cast<int>(scene.textures.size()));
  }
  require(!scene.instances.empty());
  for (const scene::Instance& instance : scene.instances) {
    require(instance.primitive < scene.primitives.size());
    for (int i = 0; i < 4; ++i) {
      requireFinite(std::initializer_list<glm::dvec4>{instance.worldFromObject[i]});
    }
  }
  requireFinite(std::initializer_list<glm::dvec3>{scene.bounds.min, scene.bounds.max});
  for (int i = 0; i < 3; ++i) require(scene.bounds.min[i] <= scene.bounds.max[i]);
}

// Poses that leave the range of numbers are refused; all others leave the scene sound.
void requireSoundPoses(scene::Scene& scene) {
  if (!scene.rig) return;
  const size_t count = std::min<size_t>(scene.rig->animations.size(), 3);
  for (size_t i = 0; i < count; ++i) {
    for (const double share : {-1.0, 0.0, 0.3, 0.5, 1.0, 2.0}) {
      const double seconds = share * scene.rig->animations[i].duration;
      if (accepted({ErrorId::kSceneInvalid},
                   [&] { scene::pose(scene, {.animation = i, .seconds = seconds}); })) {
        requireSound(scene);
      }
    }
  }
  scene::pose(scene, {});  // the file has been accepted with it
  requireSound(scene);
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  // A file that scenes may name as a buffer or an image.
  static const std::string beside = fuzz::scratchFile("b.bin", std::string(64, '\0'));
  const std::string path = fuzz::scratchFile("a.glb", fuzz::fileOf(fuzz::textOf(data, size)));
  fuzz::accepted({ErrorId::kSceneUnreadable, ErrorId::kSceneInvalid, ErrorId::kSceneExtension,
                  ErrorId::kSceneEmpty, ErrorId::kSceneTooLarge},
                 [&] {
                   scene::Scene scene = scene::loadGltf(path);
                   fuzz::requireSound(scene);
                   fuzz::requireSoundPoses(scene);
                 });
  return 0;
}
