// SPDX-License-Identifier: MIT
#include "core/scene/gltf_material.h"

#include <tiny_gltf.h>

#include <cmath>
#include <map>
#include <tuple>

#include "core/base/error.h"
#include "core/scene/gltf_file.h"

namespace grisaille::scene {
namespace {

Wrap wrapOf(int value) {
  switch (value) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::kRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::kClamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::kMirror;
    default:
      throw Error(ErrorId::kSceneInvalid, "a sampler has an unknown wrap mode: {}", value);
  }
}

class MaterialLoader {
 public:
  MaterialLoader(const std::string& path, const tinygltf::Model& model, Scene& scene)
      : path_(path), model_(model), scene_(scene) {}

  Material load(const tinygltf::Material& from, TexCoordUse& use) {
    Material material{.name = from.name,
                      .alphaCutoff = static_cast<float>(from.alphaCutoff),
                      .doubleSided = from.doubleSided};
    if (from.alphaMode == "MASK" || from.alphaMode == "BLEND") {
      material.masked = true;
      if (from.alphaMode == "BLEND") material.alphaCutoff = 0.5f;
    } else if (from.alphaMode != "OPAQUE") {
      refuse(from, fmt::format("alphaMode \"{}\" is unknown", from.alphaMode));
    }
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    if (pbr.baseColorFactor.size() != 4) refuse(from, "baseColorFactor is not four numbers");
    for (int i = 0; i < 4; ++i) {
      material.baseColor[i] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(i)]);
      if (!std::isfinite(material.baseColor[i])) refuse(from, "baseColorFactor is not finite");
    }
    if (!std::isfinite(material.alphaCutoff)) refuse(from, "alphaCutoff is not finite");
    const tinygltf::TextureInfo& info = pbr.baseColorTexture;
    if (info.index != -1) {
      material.baseColorTexture = texture(info.index);
      use = useOf(from, info);
    }
    return material;
  }

 private:
  [[noreturn]] static void refuse(const tinygltf::Material& material, std::string_view why) {
    throw Error(ErrorId::kSceneInvalid, "material \"{}\": {}", material.name, why);
  }

  static TexCoordUse useOf(const tinygltf::Material& material, const tinygltf::TextureInfo& info) {
    TexCoordUse use{.set = info.texCoord};
    const auto found = info.extensions.find("KHR_texture_transform");
    if (found != info.extensions.end()) {
      const tinygltf::Value& extension = found->second;
      const auto pair = [&](const char* key, glm::dvec2 value) {
        if (!extension.Has(key)) return value;
        const tinygltf::Value& given = extension.Get(key);
        const bool good = given.IsArray() && given.ArrayLen() == 2 && given.Get(0).IsNumber() &&
                          given.Get(1).IsNumber();
        if (!good) refuse(material, fmt::format("{} of its texture is not two numbers", key));
        return glm::dvec2(given.Get(0).GetNumberAsDouble(), given.Get(1).GetNumberAsDouble());
      };
      const glm::dvec2 offset = pair("offset", glm::dvec2(0));
      const glm::dvec2 scale = pair("scale", glm::dvec2(1));
      double angle = 0;
      if (extension.Has("rotation")) {
        if (!extension.Get("rotation").IsNumber()) {
          refuse(material, "rotation of its texture is not a number");
        }
        angle = extension.Get("rotation").GetNumberAsDouble();
      }
      if (extension.Has("texCoord") && extension.Get("texCoord").IsInt()) {
        use.set = extension.Get("texCoord").GetNumberAsInt();
      }
      // Counter-clockwise when v points down, like other renderers of the extension.
      const double c = std::cos(angle), s = std::sin(angle);
      use.transform = glm::dmat3x2(scale.x * glm::dvec2(c, -s), scale.y * glm::dvec2(s, c), offset);
    }
    if (use.set < 0) refuse(material, fmt::format("texCoord {} is out of range", use.set));
    return use;
  }

  // Returns the index into scene.textures of a glTF texture. glTF textures with equal image and
  // wrap modes share one.
  int texture(int index) {
    if (index < 0 || static_cast<size_t>(index) >= model_.textures.size()) {
      throw Error(ErrorId::kSceneInvalid, "texture {} does not exist", index);
    }
    const tinygltf::Texture& from = model_.textures[static_cast<size_t>(index)];
    if (from.source < 0) {
      throw Error(ErrorId::kSceneImage, "texture {} has no PNG or JPEG as its source", index);
    }
    Texture result;
    if (from.sampler != -1) {
      if (from.sampler < 0 || static_cast<size_t>(from.sampler) >= model_.samplers.size()) {
        throw Error(ErrorId::kSceneInvalid, "sampler {} does not exist", from.sampler);
      }
      const tinygltf::Sampler& sampler = model_.samplers[static_cast<size_t>(from.sampler)];
      result.wrapU = wrapOf(sampler.wrapS);
      result.wrapV = wrapOf(sampler.wrapT);
    }
    const auto [found, isNew] = textures_.try_emplace({from.source, result.wrapU, result.wrapV},
                                                      static_cast<int>(scene_.textures.size()));
    if (isNew) {
      result.encoded = imageBytes(path_, model_, from.source);
      const tinygltf::Image& image = model_.images[static_cast<size_t>(from.source)];
      result.name = !image.name.empty()  ? image.name
                    : !image.uri.empty() ? image.uri
                                         : fmt::format("image {}", from.source);
      scene_.textures.push_back(std::move(result));
    }
    return found->second;
  }

  const std::string& path_;
  const tinygltf::Model& model_;
  Scene& scene_;
  std::map<std::tuple<int, Wrap, Wrap>, int> textures_;
};

}  // namespace

std::vector<TexCoordUse> loadMaterials(const std::string& path, const tinygltf::Model& model,
                                       Scene& scene) {
  MaterialLoader loader(path, model, scene);
  std::vector<TexCoordUse> uses(model.materials.size());
  for (size_t i = 0; i < uses.size(); ++i) {
    scene.materials.push_back(loader.load(model.materials[i], uses[i]));
  }
  return uses;
}

}  // namespace grisaille::scene
