// SPDX-License-Identifier: MIT
// EXT_meshopt_compression.
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include "core/base/error.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_codecs.h"
#include "core/scene/gltf_file.h"
#include "core/scene/gltf_place.h"

namespace grisaille::scene {
namespace {

struct Compressed {
  std::span<const unsigned char> bytes;
  size_t stride = 0, count = 0;
  std::string mode, filter;
};

size_t numberOf(const tinygltf::Value& extension, const char* key, bool required) {
  if (!extension.Has(key) && !required) return 0;
  const bool good =
      extension.Has(key) && extension.Get(key).IsInt() && extension.Get(key).GetNumberAsInt() >= 0;
  if (!good) throw Error(ErrorId::kSceneInvalid, "{} is not a whole number of at least 0", key);
  return static_cast<size_t>(extension.Get(key).GetNumberAsInt());
}

std::string textOf(const tinygltf::Value& extension, const char* key, const char* missing) {
  if (!extension.Has(key)) return missing;
  return extension.Get(key).IsString() ? extension.Get(key).Get<std::string>() : "";
}

Compressed compressedOf(const tinygltf::Model& model, const tinygltf::Value& extension) {
  if (!extension.IsObject()) throw Error(ErrorId::kSceneInvalid, "it is not an object");
  Compressed result{.bytes = {},
                    .stride = numberOf(extension, "byteStride", true),
                    .count = numberOf(extension, "count", true),
                    .mode = textOf(extension, "mode", ""),
                    .filter = textOf(extension, "filter", "NONE")};
  const size_t buffer = numberOf(extension, "buffer", true);
  const size_t offset = numberOf(extension, "byteOffset", false);
  const size_t length = numberOf(extension, "byteLength", true);
  if (buffer >= model.buffers.size()) {
    throw Error(ErrorId::kSceneInvalid, "buffer {} does not exist", buffer);
  }
  const auto& data = model.buffers[buffer].data;
  if (offset > data.size() || length > data.size() - offset) {
    throw Error(ErrorId::kSceneInvalid, "{} bytes at offset {} exceed its buffer of {}", length,
                offset, data.size());
  }
  result.bytes = std::span(data).subspan(offset, length);
  return result;
}

[[noreturn]] void refuseMode(const Compressed& from) {
  throw Error(ErrorId::kSceneInvalid,
              "mode \"{}\" with filter \"{}\", {} elements and a stride of {} bytes is not allowed",
              oneLine(from.mode), oneLine(from.filter), from.count, from.stride);
}

bool fits(const Compressed& from) {
  const size_t s = from.stride;
  if (from.count == 0) return false;
  if (from.mode == "ATTRIBUTES") {
    if (s == 0 || s > 256 || s % 4 != 0) return false;
    if (from.filter == "OCTAHEDRAL") return s == 4 || s == 8;
    if (from.filter == "QUATERNION") return s == 8;
    return from.filter == "NONE" || from.filter == "EXPONENTIAL";
  }
  if (from.filter != "NONE" || (s != 2 && s != 4)) return false;
  return from.mode == "INDICES" || (from.mode == "TRIANGLES" && from.count % 3 == 0);
}

void applyFilter(const Compressed& from, std::vector<unsigned char>& bytes) {
  if (from.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), from.count, from.stride);
  if (from.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), from.count, from.stride);
  if (from.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), from.count, from.stride);
}

std::vector<unsigned char> decode(const Compressed& from, uint64_t& bytesLeft) {
  if (!fits(from)) refuseMode(from);
  const uint64_t size = uint64_t{from.count} * from.stride;
  if (size > bytesLeft) {
    throw Error(ErrorId::kSceneTooLarge, "compressed data of more than {} bytes", kMaxDecodedBytes);
  }
  // Even equal elements take some bits: fewer bytes are broken, and cost no memory.
  if (size / 4096 > from.bytes.size()) {
    throw Error(ErrorId::kSceneInvalid, "{} bytes cannot hold {} elements", from.bytes.size(),
                from.count);
  }
  bytesLeft -= size;
  std::vector<unsigned char> result(size);
  const auto* data = from.bytes.data();
  const size_t length = from.bytes.size();
  const int failed =
      from.mode == "ATTRIBUTES"
          ? meshopt_decodeVertexBuffer(result.data(), from.count, from.stride, data, length)
      : from.mode == "TRIANGLES"
          ? meshopt_decodeIndexBuffer(result.data(), from.count, from.stride, data, length)
          : meshopt_decodeIndexSequence(result.data(), from.count, from.stride, data, length);
  if (failed != 0) throw Error(ErrorId::kSceneInvalid, "the compressed data is broken");
  applyFilter(from, result);
  return result;
}

}  // namespace

void decodeMeshopt(tinygltf::Model& model) {
  uint64_t bytesLeft = kMaxDecodedBytes;
  std::vector<std::vector<unsigned char>> decoded;
  std::vector<size_t> views;
  for (size_t i = 0; i < model.bufferViews.size(); ++i) {
    const auto& extensions = model.bufferViews[i].extensions;
    const auto found = extensions.find("EXT_meshopt_compression");
    if (found == extensions.end()) continue;
    inPlace(fmt::format("bufferViews[{}].extensions.EXT_meshopt_compression", i), [&] {
      const Compressed from = compressedOf(model, found->second);
      decoded.push_back(decode(from, bytesLeft));
      // An accessor's elements may be smaller than the stride of the compressed ones.
      if (from.mode == "ATTRIBUTES") model.bufferViews[i].byteStride = from.stride;
      views.push_back(i);
    });
  }
  for (size_t k = 0; k < views.size(); ++k) {
    tinygltf::BufferView& view = model.bufferViews[views[k]];
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteOffset = 0;
    view.byteLength = decoded[k].size();
    model.buffers.emplace_back().data = std::move(decoded[k]);
  }
}

}  // namespace grisaille::scene
