// SPDX-License-Identifier: MIT
#include "core/scene/built_in/assembly.h"

#include <utility>

namespace grisaille::scene {
namespace {

uint32_t addMaterial(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

}  // namespace

uint32_t Assembly::plain(const char* name, const glm::vec3& colour) {
  return addMaterial(scene_, {.name = name, .baseColor = glm::vec4(colour, 1)});
}

uint32_t Assembly::cloth(const char* name, const glm::vec3& colour) {
  return addMaterial(scene_,
                     {.name = name, .baseColor = glm::vec4(colour, 1), .doubleSided = true});
}

uint32_t Assembly::foliage(const char* name, image::Image8 texels) {
  const int texture = static_cast<int>(scene_.textures.size());
  scene_.textures.push_back({.name = name,
                             .encoded = {},
                             .texels = std::move(texels),
                             .wrapU = Wrap::kClamp,
                             .wrapV = Wrap::kClamp});
  return addMaterial(
      scene_, {.name = name, .baseColorTexture = texture, .masked = true, .doubleSided = true});
}

uint32_t Assembly::add(const Solid& solid, uint32_t material, double crease) {
  return addPrimitive(scene_, solid, material, crease);
}

void Assembly::place(uint32_t primitive, const glm::dmat4& transform) {
  scene_.instances.push_back({.primitive = primitive, .worldFromObject = transform});
}

Scene Assembly::finish(const Camera& camera) {
  scene_.camera = camera;
  computeBounds(scene_);
  return std::move(scene_);
}

}  // namespace grisaille::scene
