// SPDX-License-Identifier: MIT
#include "core/scene/scene.h"

#include <limits>

#include "core/scene/framing.h"

namespace grisaille::scene {

void computeBounds(Scene& scene) {
  // First compute the box of each primitive once, because instances may share primitives.
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

image::Image8 texelsOf(const Texture& texture) {
  if (!texture.texels.pixels.empty()) return texture.texels;
  return image::decode(texture.encoded, texture.name);
}

uint64_t triangleCount(const Scene& scene) {
  uint64_t count = 0;
  for (const Instance& instance : scene.instances) {
    count += scene.primitives[instance.primitive].indexCount / 3;
  }
  return count;
}

Scene loadScene(const std::string& path, const std::function<void(double)>& progress) {
  return path.empty() ? makeAtrium() : loadGltf(path, progress);
}

Camera defaultCamera(const Scene& scene, double aspect) {
  return scene.camera ? *scene.camera : framingCamera(scene, aspect);
}

}  // namespace grisaille::scene
