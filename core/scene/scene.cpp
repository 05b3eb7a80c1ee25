// SPDX-License-Identifier: MIT
#include "core/scene/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/base/note.h"
#include "core/scene/built_in.h"
#include "core/scene/framing.h"

namespace grisaille::scene {

std::vector<Bounds> primitiveBounds(const Scene& scene) {
  std::vector<Bounds> boxes(scene.primitives.size());
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Primitive& primitive = scene.primitives[i];
    constexpr float kFar = std::numeric_limits<float>::max();
    glm::vec3 low(kFar), high(-kFar);
    for (uint32_t k = 0; k < primitive.indexCount; ++k) {
      const glm::vec3& p = scene.positions[scene.indices[primitive.firstIndex + k]];
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    boxes[i] = {.min = low, .max = high};
  }
  return boxes;
}

void computeBounds(Scene& scene) {
  // First compute the box of each primitive once, because instances may share primitives.
  const std::vector<Bounds> boxes = primitiveBounds(scene);
  constexpr double kFar = std::numeric_limits<double>::max();
  Bounds bounds{.min = glm::dvec3(kFar), .max = glm::dvec3(-kFar)};
  for (const Instance& instance : scene.instances) {
    const Bounds& box = boxes[instance.primitive];
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 p((corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                         (corner & 4 ? box.max : box.min).z, 1);
      const glm::dvec3 world(instance.worldFromObject * p);
      bounds.min = glm::min(bounds.min, world);
      bounds.max = glm::max(bounds.max, world);
    }
  }
  scene.bounds = scene.instances.empty() ? Bounds{} : bounds;
}

namespace {

// Decodes by `decode`, or returns `instead` and says why.
template <typename Decode>
auto decodedOr(Decode&& decode, decltype(decode()) instead) {
  try {
    return decode();
  } catch (const Error& error) {
    if (error.id() != ErrorId::kSceneImage) throw;
    note(fmt::format("{}; white and opaque instead", error.detail()));
    return instead;
  }
}

}  // namespace

image::Image8 texelsOf(const Texture& texture) {
  if (!texture.texels.pixels.empty()) return texture.texels;
  return decodedOr([&] { return image::decode(texture.encoded, texture.name); },
                   {.width = 1, .height = 1, .pixels = std::vector<uint8_t>(4, 255)});
}

image::Alpha8 alphaOf(const Texture& texture) {
  const image::Image8& texels = texture.texels;
  if (texels.pixels.empty()) {
    return decodedOr([&] { return image::decodeAlpha(texture.encoded, texture.name); },
                     {.width = 1, .height = 1, .pixels = {255}});
  }
  image::Alpha8 alpha{.width = texels.width,
                      .height = texels.height,
                      .pixels = std::vector<uint8_t>(texels.pixels.size() / 4)};
  for (size_t i = 0; i < alpha.pixels.size(); ++i) alpha.pixels[i] = texels.pixels[4 * i + 3];
  return alpha;
}

uint64_t triangleCount(const Scene& scene) {
  uint64_t count = 0;
  for (const Instance& instance : scene.instances) {
    count += scene.primitives[instance.primitive].indexCount / 3;
  }
  return count;
}

namespace {

// Suggests a built-in scene where a path without extension names no file: loadGltf() knows files
// alone.
void requireFileOrName(const std::string& path) {
  std::error_code failed;
  const std::filesystem::path file(path);
  if (file.has_extension() || file.has_parent_path() || std::filesystem::exists(file, failed))
    return;
  std::vector<std::string> names;
  for (const BuiltIn& one : builtIns()) names.emplace_back(one.name);
  const std::string near = nearest(path, names);
  throw Error(ErrorId::kSceneUnreadable,
              "{}: no such file, and no built-in scene has this name{}; built-in are {}",
              oneLine(path), near.empty() ? "" : ", nearest is " + near, builtInNames());
}

}  // namespace

Scene readScene(const std::string& path, const std::function<void(double)>& progress) {
  if (const BuiltIn* builtIn = findBuiltIn(path)) return builtIn->make();
  requireFileOrName(path);
  return loadGltf(path, progress);
}

Scene loadScene(const std::string& path, const std::function<void(double)>& progress) {
  Scene scene = readScene(path, progress);
  for (const std::string& line : scene.notes) note(fmt::format("{}: {}", path, line));
  return scene;
}

Camera defaultCamera(const Scene& scene, double aspect) {
  return scene.camera ? *scene.camera : framingCamera(scene, aspect);
}

}  // namespace grisaille::scene
