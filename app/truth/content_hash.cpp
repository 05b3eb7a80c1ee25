// SPDX-License-Identifier: MIT
#include "app/truth/content_hash.h"

namespace grisaille::app::truth {

uint64_t hashOf(const scene::Scene& scene) {
  ContentHash hash;
  hash.add<glm::vec3>(scene.positions);
  hash.add<glm::vec3>(scene.normals);
  hash.add<glm::vec2>(scene.texCoords);
  hash.add<glm::vec4>(scene.colours);
  hash.add<uint32_t>(scene.indices);
  for (const scene::Primitive& primitive : scene.primitives) {
    hash.number(primitive.firstIndex);
    hash.number(primitive.indexCount);
    hash.number(primitive.material);
    if (primitive.coloured) hash.number(primitive.coloured);
  }
  for (const scene::Material& material : scene.materials) {
    hash.number(material.baseColor.a);
    hash.number(material.baseColorTexture);
    hash.number(material.masked);
    hash.number(material.alphaCutoff);
    hash.number(material.doubleSided);
  }
  for (const scene::Texture& texture : scene.textures) {
    hash.add<std::byte>(texture.encoded);
    hash.number(texture.texels.width);
    hash.add<uint8_t>(texture.texels.pixels);
    hash.number(texture.wrapU);
    hash.number(texture.wrapV);
  }
  for (const scene::Instance& instance : scene.instances) {
    hash.number(instance.primitive);
    hash.add<glm::dmat4>(std::span(&instance.worldFromObject, 1));
  }
  return hash.value();
}

}  // namespace grisaille::app::truth
