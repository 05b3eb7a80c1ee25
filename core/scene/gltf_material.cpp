// SPDX-License-Identifier: MIT
#include "core/scene/gltf_material.h"

#include <tiny_gltf.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

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
    const Base base = baseOf(from);
    if (base.factor.size() != 4) refuse(from, fmt::format("{} is not four numbers", base.name));
    for (int i = 0; i < 4; ++i) {
      material.baseColor[i] = static_cast<float>(base.factor[static_cast<size_t>(i)]);
      if (!std::isfinite(material.baseColor[i])) {
        refuse(from, fmt::format("{} is not finite", base.name));
      }
    }
    if (!std::isfinite(material.alphaCutoff)) refuse(from, "alphaCutoff is not finite");
    if (base.texture.index != -1) {
      material.baseColorTexture = texture(base.texture.index);
      use = useOf(from, base.texture);
    }
    return material;
  }

 private:
  [[noreturn]] static void refuse(const tinygltf::Material& material, std::string_view why) {
    throw Error(ErrorId::kSceneInvalid, "material \"{}\": {}", material.name, why);
  }

  // The base colour of a material: factor and texture.
  struct Base {
    const char* name;
    std::vector<double> factor;
    tinygltf::TextureInfo texture;
  };

  static Base baseOf(const tinygltf::Material& from) {
    const auto found = from.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (found == from.extensions.end()) {
      const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
      return {"baseColorFactor", pbr.baseColorFactor, pbr.baseColorTexture};
    }
    const tinygltf::Value& extension = found->second;
    Base base{"diffuseFactor", {1, 1, 1, 1}, {}};
    if (extension.Has("diffuseFactor")) {
      const tinygltf::Value& factor = extension.Get("diffuseFactor");
      base.factor.clear();
      for (size_t i = 0; factor.IsArray() && i < factor.ArrayLen(); ++i) {
        const tinygltf::Value& number = factor.Get(static_cast<int>(i));
        if (!number.IsNumber()) refuse(from, "diffuseFactor is not four numbers");
        base.factor.push_back(number.GetNumberAsDouble());
      }
    }
    if (extension.Has("diffuseTexture")) {
      const tinygltf::Value& texture = extension.Get("diffuseTexture");
      const auto whole = [&](const char* key, int missing) {
        if (!texture.IsObject() || !texture.Has(key)) return missing;
        if (!texture.Get(key).IsInt()) {
          refuse(from, fmt::format("diffuseTexture.{} is not a whole number", key));
        }
        return texture.Get(key).GetNumberAsInt();
      };
      base.texture.index = whole("index", -2);
      base.texture.texCoord = whole("texCoord", 0);
      if (texture.IsObject() && texture.Has("extensions")) {
        const tinygltf::Value& extensions = texture.Get("extensions");
        for (const std::string& key : extensions.Keys()) {
          base.texture.extensions.emplace(key, extensions.Get(key));
        }
      }
    }
    return base;
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

  // Returns the image of a texture; -1: none in a format that can be read.
  static int sourceOf(const tinygltf::Texture& texture) {
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp != texture.extensions.end() && webp->second.IsObject() && webp->second.Has("source") &&
        webp->second.Get("source").IsInt()) {
      return webp->second.Get("source").GetNumberAsInt();
    }
    return texture.source;
  }

  // Returns the index into scene.textures of a glTF texture. glTF textures with equal image and
  // wrap modes share one. Returns -1, with a note, if its image cannot be read.
  int texture(int index) {
    if (index < 0 || static_cast<size_t>(index) >= model_.textures.size()) {
      throw Error(ErrorId::kSceneInvalid, "texture {} does not exist", index);
    }
    const tinygltf::Texture& from = model_.textures[static_cast<size_t>(index)];
    Texture result;
    if (from.sampler != -1) {
      if (from.sampler < 0 || static_cast<size_t>(from.sampler) >= model_.samplers.size()) {
        throw Error(ErrorId::kSceneInvalid, "sampler {} does not exist", from.sampler);
      }
      const tinygltf::Sampler& sampler = model_.samplers[static_cast<size_t>(from.sampler)];
      result.wrapU = wrapOf(sampler.wrapS);
      result.wrapV = wrapOf(sampler.wrapT);
    }
    const int source = sourceOf(from);
    if (source == -1) {
      leaveOut(fmt::format("textures[{}] has no PNG, JPEG or WebP", index));
      return -1;
    }
    const auto [found, isNew] = textures_.try_emplace({source, result.wrapU, result.wrapV}, -1);
    if (!isNew) return found->second;
    try {
      result.encoded = imageBytes(path_, model_, source);
    } catch (const Error& error) {
      if (error.id() != ErrorId::kSceneImage) throw;
      leaveOut(fmt::format("images[{}]: {}", source, error.detail()));
      return -1;
    }
    const tinygltf::Image& image = model_.images[static_cast<size_t>(source)];
    result.name = !image.name.empty()  ? image.name
                  : !image.uri.empty() ? image.uri
                                       : fmt::format("image {}", source);
    found->second = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(std::move(result));
    return found->second;
  }

  void leaveOut(const std::string& what) {
    const std::string line = what + "; white and opaque instead";
    if (leftOut_.insert(line).second) scene_.notes.push_back(line);
  }

  const std::string& path_;
  const tinygltf::Model& model_;
  Scene& scene_;
  std::map<std::tuple<int, Wrap, Wrap>, int> textures_;
  std::set<std::string> leftOut_;
};

}  // namespace

std::vector<TexCoordUse> loadMaterials(const std::string& path, const tinygltf::Model& model,
                                       Scene& scene) {
  MaterialLoader loader(path, model, scene);
  std::vector<TexCoordUse> uses(model.materials.size());
  size_t blended = 0;
  for (size_t i = 0; i < uses.size(); ++i) {
    scene.materials.push_back(inPlace(fmt::format("materials[{}]", i),
                                      [&] { return loader.load(model.materials[i], uses[i]); }));
    if (model.materials[i].alphaMode == "BLEND") ++blended;
  }
  if (blended > 0) {
    scene.notes.push_back(
        fmt::format("{} of {} materials blend; drawn as masks, whose holes have an alpha below 0.5",
                    blended, model.materials.size()));
  }
  return uses;
}

}  // namespace grisaille::scene
