// SPDX-License-Identifier: MIT
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/scene/scene.h"

namespace grisaille::scene {
namespace {

using nlohmann::json;

// Constants of the glTF format.
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

int wrapNumber(Wrap wrap) {
  switch (wrap) {
    case Wrap::kRepeat:
      return 10497;
    case Wrap::kClamp:
      return 33071;
    case Wrap::kMirror:
      return 33648;
  }
  return 10497;
}

const char* mimeTypeOf(const std::vector<std::byte>& encoded) {
  if (encoded.empty()) return "image/png";
  if (encoded[0] == std::byte{0xff}) return "image/jpeg";
  return encoded[0] == std::byte{'R'} ? "image/webp" : "image/png";
}

class GlbWriter {
 public:
  explicit GlbWriter(const Scene& scene) : scene_(scene) {}

  std::string write() {
    document_["asset"] = {{"version", "2.0"}, {"generator", "Grisaille"}};
    addVertices();
    addMaterials();
    addTextures();
    addNodes();
    push("buffers", json::object({{"byteLength", binary_.size()}}));
    return pack();
  }

 private:
  // Appends bytes at a multiple of 4, which suits every accessor, and returns the buffer view.
  size_t addView(const void* bytes, size_t size, int target) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    binary_.append(static_cast<const char*>(bytes), size);
    return push("bufferViews", std::move(view));
  }

  size_t push(const char* list, json entry) {
    json& array = document_[list];
    array.push_back(std::move(entry));
    return array.size() - 1;
  }

  template <typename T>
  size_t addAttribute(const std::vector<T>& values, const char* type) {
    const size_t view = addView(values.data(), values.size() * sizeof(T), kArrayBuffer);
    return push("accessors", {{"bufferView", view},
                              {"componentType", kFloat},
                              {"count", values.size()},
                              {"type", type}});
  }

  void addVertices() {
    attributes_ = {{"POSITION", addAttribute(scene_.positions, "VEC3")},
                   {"NORMAL", addAttribute(scene_.normals, "VEC3")},
                   {"TEXCOORD_0", addAttribute(scene_.texCoords, "VEC2")}};
    // All primitives share the vertices, so that those without colours get white ones.
    if (!scene_.colours.empty()) {
      attributes_["COLOR_0"] = addAttribute(scene_.colours, "VEC4");
    }
    glm::vec3 low = scene_.positions.at(0), high = low;
    for (const glm::vec3& p : scene_.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    json& positions = document_["accessors"][attributes_["POSITION"].get<size_t>()];
    positions["min"] = {low.x, low.y, low.z};
    positions["max"] = {high.x, high.y, high.z};
    indexView_ = addView(scene_.indices.data(), scene_.indices.size() * sizeof(uint32_t),
                         kElementArrayBuffer);
  }

  void addMaterials() {
    for (const Material& material : scene_.materials) {
      const glm::vec4& c = material.baseColor;
      json pbr{{"baseColorFactor", {c.r, c.g, c.b, c.a}}, {"metallicFactor", 0}};
      if (material.baseColorTexture >= 0) {
        pbr["baseColorTexture"]["index"] = material.baseColorTexture;
      }
      json entry{{"name", material.name},
                 {"pbrMetallicRoughness", std::move(pbr)},
                 {"doubleSided", material.doubleSided}};
      if (material.masked) {
        entry["alphaMode"] = "MASK";
        entry["alphaCutoff"] = material.alphaCutoff;
      }
      push("materials", std::move(entry));
    }
  }

  void addTextures() {
    for (const Texture& texture : scene_.textures) {
      const bool made = !texture.texels.pixels.empty();
      const std::vector<std::byte> bytes =
          made ? image::encodePng(texture.texels) : texture.encoded;
      const std::string type = mimeTypeOf(bytes);
      const size_t view = addView(bytes.data(), bytes.size(), 0);
      const size_t image =
          push("images", {{"name", texture.name}, {"bufferView", view}, {"mimeType", type}});
      const size_t sampler = push(
          "samplers", {{"wrapS", wrapNumber(texture.wrapU)}, {"wrapT", wrapNumber(texture.wrapV)}});
      json entry{{"sampler", sampler}};
      if (type == "image/webp") {
        entry["extensions"]["EXT_texture_webp"]["source"] = image;
        document_["extensionsUsed"] = document_["extensionsRequired"] = {"EXT_texture_webp"};
      } else {
        entry["source"] = image;
      }
      push("textures", std::move(entry));
    }
  }

  void addNodes() {
    for (const Primitive& primitive : scene_.primitives) {
      const size_t indices = push("accessors", {{"bufferView", indexView_},
                                                {"byteOffset", primitive.firstIndex * uint64_t{4}},
                                                {"componentType", kUnsignedInt},
                                                {"count", primitive.indexCount},
                                                {"type", "SCALAR"}});
      json run{{"attributes", attributes_}, {"indices", indices}, {"material", primitive.material}};
      push("meshes", json::object({{"primitives", json::array({std::move(run)})}}));
    }
    json roots = json::array();
    for (const Instance& instance : scene_.instances) {
      json node = json::object({{"mesh", instance.primitive}});
      if (instance.worldFromObject != glm::dmat4(1)) {
        json& matrix = node["matrix"];
        for (int i = 0; i < 16; ++i) matrix.push_back(instance.worldFromObject[i / 4][i % 4]);
      }
      roots.push_back(push("nodes", std::move(node)));
    }
    document_["scene"] = 0;
    push("scenes", {{"name", scene_.name}, {"nodes", std::move(roots)}});
  }

  std::string pack() {
    // Names may hold any bytes, but the format requires UTF-8.
    std::string text = document_.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    const uint64_t total = 12 + 8 + uint64_t{text.size()} + 8 + binary_.size();
    if (total > std::numeric_limits<uint32_t>::max()) {
      throw Error(ErrorId::kSceneTooLarge, "{} bytes; a .glb holds less than 4 GiB", total);
    }
    std::string file;
    file.reserve(total);
    const auto word = [&](uint64_t value) {
      const auto narrow = static_cast<uint32_t>(value);
      for (int shift = 0; shift < 32; shift += 8) {
        file.push_back(static_cast<char>(narrow >> shift & 0xff));
      }
    };
    for (const uint64_t value : {uint64_t{kMagic}, uint64_t{2}, total}) word(value);
    word(text.size());
    word(kJsonChunk);
    file += text;
    word(binary_.size());
    word(kBinaryChunk);
    file += binary_;
    return file;
  }

  const Scene& scene_;
  json document_;
  std::string binary_;
  json attributes_;
  size_t indexView_ = 0;
};

}  // namespace

void writeGlb(const Scene& scene, const std::string& path) {
  if (scene.positions.empty() || scene.instances.empty()) {
    throw Error(ErrorId::kSceneEmpty, "{}: the scene has nothing to write", path);
  }
  writeFileAtomically(path, GlbWriter(scene).write());
}

}  // namespace grisaille::scene
