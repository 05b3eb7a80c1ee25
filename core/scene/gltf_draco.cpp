// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression.
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_codecs.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

namespace grisaille::scene {
namespace {

using Bytes = std::vector<unsigned char>;

[[noreturn]] void refuseData(const std::string& why) {
  throw Error(ErrorId::kSceneInvalid, "{}", why);
}

// The sizes that the glTF file declares for a primitive. Draco allocates by the sizes in its own
// data, before it finds that bytes are missing: the decoders below check them first.
struct Declared {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  uint64_t bytesLeft = 0;  // that decoded attributes may take
};

// A decoder of Draco that refuses sizes above the declared ones.
template <typename Decoder>
class Bounded : public Decoder {
 public:
  explicit Bounded(const Declared& declared) : declared_(declared) {}

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    uint32_t first = 0, second = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    constexpr bool kSequential = std::is_same_v<Decoder, draco::MeshSequentialDecoder>;
    const uint32_t faces = kSequential ? first : second, vertices = kSequential ? second : first;
    if (faces > declared_.faces || vertices > declared_.vertices) return false;
    return Decoder::DecodeConnectivity() && this->point_cloud()->num_points() == declared_.vertices;
  }

  bool DecodeAllAttributes() override {
    uint64_t bytes = 0;
    for (int i = 0; i < this->point_cloud()->num_attributes(); ++i) {
      const draco::PointAttribute* attribute = this->point_cloud()->attribute(i);
      // The values, and the integers that they are decoded from.
      bytes += declared_.vertices * (static_cast<uint64_t>(attribute->byte_stride()) +
                                     uint64_t{4} * attribute->num_components());
    }
    return bytes <= declared_.bytesLeft && Decoder::DecodeAllAttributes();
  }

 private:
  Declared declared_;
};

template <typename Decoder>
bool decodeBy(const Declared& declared, std::span<const unsigned char> bytes, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Bounded<Decoder> decoder(declared);
  return decoder.Decode(draco::DecoderOptions(), &buffer, &mesh).ok();
}

void decodeMesh(const Declared& declared, std::span<const unsigned char> bytes, draco::Mesh& mesh) {
  // Few bytes may hold many equal elements, but not without a limit.
  const uint64_t most = std::max(declared.vertices, declared.faces);
  if (most > kMaxZeroElements && most > 64 * bytes.size()) {
    refuseData(fmt::format("{} bytes cannot hold {} vertices and {} faces", bytes.size(),
                           declared.vertices, declared.faces));
  }
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() ||
      header.encoder_type != draco::TRIANGULAR_MESH) {
    refuseData("the compressed data is not a Draco mesh");
  }
  // The version that the extension requires.
  if (header.version_major != 2 || header.version_minor != 2) {
    refuseData(fmt::format("Draco version {}.{}; only 2.2 is allowed", header.version_major,
                           header.version_minor));
  }
  const bool good = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
                        ? decodeBy<draco::MeshEdgebreakerDecoder>(declared, bytes, mesh)
                        : decodeBy<draco::MeshSequentialDecoder>(declared, bytes, mesh);
  if (!good || mesh.num_faces() != declared.faces) {
    refuseData(
        fmt::format("the compressed data is broken, or does not have {} vertices and {} faces",
                    declared.vertices, declared.faces));
  }
}

// Adds an accessor for packed elements. Returns its index.
int addAccessor(tinygltf::Model& model, tinygltf::Accessor accessor, Bytes bytes) {
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = bytes.size();
  model.buffers.emplace_back().data = std::move(bytes);
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.byteOffset = 0;
  accessor.sparse = {};
  accessor.sparse.isSparse = false;
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

template <typename T>
Bytes elementsAs(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components) {
  Bytes bytes(size_t{mesh.num_points()} * static_cast<size_t>(components) * sizeof(T));
  std::vector<T> element(static_cast<size_t>(components));
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const auto value = attribute.mapped_index(draco::PointIndex(i));
    if (value.value() >= attribute.size() ||
        !attribute.ConvertValue<T>(value, static_cast<int8_t>(components), element.data())) {
      refuseData("an attribute of the compressed data does not have the accessor's type");
    }
    std::memcpy(&bytes[size_t{i} * element.size() * sizeof(T)], element.data(),
                element.size() * sizeof(T));
  }
  return bytes;
}

Bytes elementsOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                 const tinygltf::Accessor& accessor) {
  const int components = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type));
  if (components < 1 || components > 4) refuseData("the accessor is not of scalars or vectors");
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return elementsAs<int8_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return elementsAs<uint8_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return elementsAs<int16_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return elementsAs<uint16_t>(mesh, attribute, components);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return elementsAs<float>(mesh, attribute, components);
    default:
      refuseData(fmt::format("component type {} cannot be compressed", accessor.componentType));
  }
}

const tinygltf::Accessor& accessorNamed(const tinygltf::Model& model, int index) {
  accessorCount(model, index);  // checks the index
  return model.accessors[static_cast<size_t>(index)];
}

class DracoReader {
 public:
  explicit DracoReader(tinygltf::Model& model) : model_(model) {}

  void read(tinygltf::Primitive& primitive, const tinygltf::Value& extension) {
    if (!extension.IsObject() || !extension.Has("bufferView") ||
        !extension.Get("bufferView").IsInt() || !extension.Has("attributes") ||
        !extension.Get("attributes").IsObject()) {
      refuseData("bufferView or attributes are missing");
    }
    const int view = extension.Get("bufferView").GetNumberAsInt();
    const tinygltf::Value& attributes = extension.Get("attributes");
    // Primitives with the same compressed data share its accessors.
    std::vector<int> key{view, primitive.indices};
    std::map<std::string, int> ids;
    for (const std::string& name : attributes.Keys()) {
      if (!attributes.Get(name).IsInt() || !primitive.attributes.contains(name)) {
        refuseData(fmt::format("attributes.{} does not name an attribute of the primitive", name));
      }
      ids[name] = attributes.Get(name).GetNumberAsInt();
      key.insert(key.end(), {ids[name], primitive.attributes[name]});
    }
    const auto [found, isNew] = known_.try_emplace(std::move(key));
    if (isNew) found->second = decode(primitive, view, ids);
    for (const auto& [name, accessor] : found->second.attributes) {
      primitive.attributes[name] = accessor;
    }
    primitive.indices = found->second.indices;
    // The faces of the data are triangles, even if the primitive is a strip.
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
  }

 private:
  struct Accessors {
    std::map<std::string, int> attributes;
    int indices = -1;
  };

  Accessors decode(const tinygltf::Primitive& primitive, int view,
                   const std::map<std::string, int>& ids) {
    if (!ids.contains("POSITION")) refuseData("attributes.POSITION is missing");
    Declared declared{.vertices = accessorCount(model_, primitive.attributes.at("POSITION")),
                      .bytesLeft = bytesLeft_};
    const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    if (!strip && primitive.mode != TINYGLTF_MODE_TRIANGLES) {
      refuseData(fmt::format("mode {} cannot be compressed", primitive.mode));
    }
    const uint64_t indices = accessorCount(model_, primitive.indices);
    declared.faces = strip ? indices - std::min<uint64_t>(indices, 2) : indices / 3;
    if (declared.vertices > kMaxVertices || indices > kMaxIndices) {
      throw Error(ErrorId::kSceneTooLarge, "{} vertices and {} indices; the limits are {} and {}",
                  declared.vertices, indices, kMaxVertices, kMaxIndices);
    }
    draco::Mesh mesh;
    const std::span<const unsigned char> bytes = viewBytes(model_, view);
    decodeMesh(declared, bytes, mesh);
    Accessors result;
    for (const auto& [name, id] : ids) {
      const draco::PointAttribute* attribute =
          id < 0 ? nullptr : mesh.GetAttributeByUniqueId(static_cast<uint32_t>(id));
      if (attribute == nullptr)
        refuseData(fmt::format("attributes.{}: {} is not in the data", name, id));
      tinygltf::Accessor accessor = accessorNamed(model_, primitive.attributes.at(name));
      accessor.count = mesh.num_points();
      Bytes elements = elementsOf(mesh, *attribute, accessor);
      spend(elements.size());
      result.attributes[name] = addAccessor(model_, std::move(accessor), std::move(elements));
    }
    result.indices = indicesOf(mesh);
    return result;
  }

  int indicesOf(const draco::Mesh& mesh) {
    std::vector<uint32_t> indices;
    indices.reserve(size_t{mesh.num_faces()} * 3);
    for (uint32_t i = 0; i < mesh.num_faces(); ++i) {
      for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(i))) {
        indices.push_back(point.value());
      }
    }
    const auto bytes = std::as_bytes(std::span(indices));
    spend(bytes.size());
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    accessor.count = indices.size();
    const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
    return addAccessor(model_, std::move(accessor), Bytes(first, first + bytes.size()));
  }

  void spend(uint64_t bytes) {
    if (bytes > bytesLeft_) {
      throw Error(ErrorId::kSceneTooLarge, "compressed data of more than {} bytes",
                  kMaxDecodedBytes);
    }
    bytesLeft_ -= bytes;
  }

  tinygltf::Model& model_;
  uint64_t bytesLeft_ = kMaxDecodedBytes;
  std::map<std::vector<int>, Accessors> known_;
};

}  // namespace

void decodeDraco(tinygltf::Model& model) {
  DracoReader reader(model);
  for (size_t m = 0; m < model.meshes.size(); ++m) {
    for (size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
      tinygltf::Primitive& primitive = model.meshes[m].primitives[p];
      const auto found = primitive.extensions.find("KHR_draco_mesh_compression");
      if (found == primitive.extensions.end()) continue;
      inPlace(fmt::format("meshes[{}].primitives[{}].extensions.KHR_draco_mesh_compression", m, p),
              [&] { reader.read(primitive, found->second); });
    }
  }
}

}  // namespace grisaille::scene
