// SPDX-License-Identifier: MIT
#include "core/scene/gltf_file.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/base/error.h"
#include "core/base/regular_file.h"
#include "core/scene/gltf_accessor.h"
#include "core/scene/gltf_codecs.h"
#include "core/scene/gltf_document.h"

namespace grisaille::scene {
namespace {

using nlohmann::json;
using Bytes = std::vector<unsigned char>;

constexpr uint64_t kMaxFileBytes = std::numeric_limits<uint32_t>::max();
// Limits the recursion of tinygltf into `extras`. Real files nest a dozen levels.
constexpr int kDeepestJson = 64;

// `name`: for messages; the name of a file that the scene refers to, empty for the scene's own
// file.
Bytes readFile(const std::filesystem::path& path, const std::string& name, uint64_t mostBytes,
               ErrorId id) {
  std::error_code code;
  const std::string subject = name.empty() ? "" : fmt::format("file \"{}\": ", name);
  const std::string why = whyNotRegular(path);
  if (!why.empty()) throw Error(id, "{}{}", subject, why);
  const uintmax_t size = std::filesystem::file_size(path, code);
  if (code) throw Error(id, "{}{}", subject, code.message());
  if (size > mostBytes) {
    throw Error(ErrorId::kSceneTooLarge, "{}{} bytes; the limit is {}", subject, size, mostBytes);
  }
  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file) throw Error(id, "{}cannot be read", subject);
  return bytes;
}

// Returns the path of a file that the scene refers to. The file must be in or below the scene's
// folder.
std::filesystem::path besideScene(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path relative(name);
  bool leaves = relative.is_absolute() || name.empty() || name.find('\0') != std::string::npos;
  for (const auto& part : relative) leaves = leaves || part == "..";
  if (leaves) {
    throw Error(ErrorId::kSceneInvalid, "\"{}\" leads out of the scene's folder", name);
  }
  return folder / relative;
}

// The state of tinygltf's file callbacks.
struct Files {
  std::filesystem::path folder;
  size_t buffersLeft = 0;  // tinygltf loads external buffers first, then external images
  uint64_t bytesLeft = kMaxFileBytes;
};

bool readForTinygltf(Bytes* out, std::string*, const std::string& name, void* user) {
  Files& files = *static_cast<Files*>(user);
  if (files.buffersLeft == 0) {
    // An image: return its decoded name instead of its bytes. imageBytes() reads the file when a
    // material needs it.
    out->assign(name.begin(), name.end());
    return true;
  }
  --files.buffersLeft;
  *out =
      readFile(besideScene(files.folder, name), name, files.bytesLeft, ErrorId::kSceneUnreadable);
  files.bytesLeft -= out->size();
  return true;
}

bool keepImage(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
               const unsigned char* bytes, int size, void*) {
  // An image in a buffer stays in the buffer. Do not access `bytes`: its range is not checked yet.
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

uint32_t word(const Bytes& bytes, size_t offset) {
  return static_cast<uint32_t>(bytes[offset]) | static_cast<uint32_t>(bytes[offset + 1]) << 8 |
         static_cast<uint32_t>(bytes[offset + 2]) << 16 |
         static_cast<uint32_t>(bytes[offset + 3]) << 24;
}

bool isBinary(const Bytes& bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

std::span<const unsigned char> jsonOf(const Bytes& bytes) {
  if (!isBinary(bytes)) return bytes;
  constexpr size_t kHeader = 20;  // file header and first chunk's header
  constexpr uint32_t kJsonChunk = 0x4e4f534a;
  if (bytes.size() < kHeader) throw Error(ErrorId::kSceneUnreadable, "the header is truncated");
  if (word(bytes, 4) != 2) {
    throw Error(ErrorId::kSceneUnreadable, "binary glTF version {}; only version 2 is supported",
                word(bytes, 4));
  }
  if (word(bytes, 8) > bytes.size()) {
    throw Error(ErrorId::kSceneUnreadable, "the header announces {} bytes, but the file has {}",
                word(bytes, 8), bytes.size());
  }
  const size_t length = word(bytes, 12);
  if (word(bytes, 16) != kJsonChunk || length > bytes.size() - kHeader) {
    throw Error(ErrorId::kSceneUnreadable, "the first chunk is not JSON or is truncated");
  }
  // tinygltf ignores the size of the second chunk's header here and would read past the end.
  const size_t second = kHeader + length;
  if (word(bytes, 8) > second &&
      (bytes.size() - second < 8 || word(bytes, second) > bytes.size() - second - 8)) {
    throw Error(ErrorId::kSceneUnreadable, "the second chunk is truncated");
  }
  return std::span(bytes).subspan(kHeader, length);
}

// Accepts any JSON of at most kDeepestJson levels. (The parser's own callback reports the depth
// too, but takes time quadratic in the length of a list.)
class DepthCheck : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t&) override { return true; }
  bool start_object(size_t) override { return enter(); }
  bool start_array(size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(size_t, const std::string&, const json::exception& error) override {
    throw Error(ErrorId::kSceneUnreadable, "{}", error.what());
  }

 private:
  bool enter() {
    if (++depth_ <= kDeepestJson) return true;
    throw Error(ErrorId::kSceneTooLarge, "the JSON nests deeper than {} levels", kDeepestJson);
  }
  bool leave() { return --depth_ >= 0; }

  int depth_ = 0;
};

json parseJson(std::span<const unsigned char> text) {
  DepthCheck check;
  json::sax_parse(text.begin(), text.end(), &check);
  return json::parse(text.begin(), text.end());
}

void checkAsset(const json& document) {
  const auto asset = document.find("asset");
  if (!document.is_object() || asset == document.end() || !asset->is_object() ||
      !asset->contains("version") || !(*asset)["version"].is_string()) {
    throw Error(ErrorId::kSceneUnreadable, "the file has no asset.version: it is not glTF");
  }
  // Accepts newer minor versions, unless `minVersion` requires one.
  const auto version = (*asset)["version"].get<std::string>();
  const auto minimum = asset->value("minVersion", json("2.0"));
  if (!version.starts_with("2.") || minimum != "2.0") {
    throw Error(ErrorId::kSceneUnreadable, "glTF version {} (minVersion {}); only 2.0 is supported",
                version, minimum.dump());
  }
}

// tinygltf reads a negative or malformed number as 0, like a number that is absent.
void checkSizes(const json& object, const std::string& place) {
  if (!object.is_object()) return;
  for (const char* key : {"byteOffset", "byteLength", "byteStride", "count"}) {
    const auto size = object.find(key);
    if (size == object.end() || size->is_number_unsigned()) continue;
    throw Error(ErrorId::kSceneInvalid, "{}.{} is {}, not a whole number of at least 0", place, key,
                oneLine(size->dump()));
  }
  for (const char* key : {"sparse", "indices", "values"}) {
    const auto inner = object.find(key);
    if (inner != object.end()) checkSizes(*inner, fmt::format("{}.{}", place, key));
  }
}

void checkSizes(const json& document) {
  for (const char* list : {"buffers", "bufferViews", "accessors"}) {
    const auto found = document.find(list);
    if (found == document.end() || !found->is_array()) continue;
    for (size_t i = 0; i < found->size(); ++i) {
      checkSizes((*found)[i], fmt::format("{}[{}]", list, i));
    }
  }
}

// Returns the number of buffers that tinygltf will read from external files.
size_t externalBuffers(const json& document) {
  size_t external = 0, embedded = 0;
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array()) return 0;
  for (const json& buffer : *buffers) {
    const auto uri = buffer.find("uri");
    if (!buffer.is_object() || uri == buffer.end()) {
      ++embedded;
    } else if (!uri->is_string() || !uri->get_ref<const std::string&>().starts_with("data:")) {
      ++external;
    }
  }
  // tinygltf would copy the binary chunk once for each of these buffers.
  if (embedded > 1)
    throw Error(ErrorId::kSceneInvalid, "{} buffers without a uri; at most one is allowed",
                embedded);
  return external;
}

// tinygltf 2.9 requires all callbacks or none, and has one more than 2.5. GetFileSizeInBytes()
// reports 0, because readForTinygltf() limits the sizes.
template <typename Callbacks>
Callbacks callbacksFor(Files& files) {
  Callbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = readForTinygltf;
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const Bytes&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](size_t* bytes, std::string*, const std::string&, void*) {
      *bytes = 0;
      return true;
    };
  }
  callbacks.user_data = &files;
  return callbacks;
}

// Replaces the JSON of a file.
void replaceJson(Bytes& bytes, const json& document) {
  std::string text = document.dump();
  if (!isBinary(bytes)) {
    bytes.assign(text.begin(), text.end());
    return;
  }
  text.resize((text.size() + 3) / 4 * 4, ' ');
  constexpr size_t kHeader = 20;
  const auto setWord = [&](size_t offset, uint64_t value) {
    if (value > kMaxFileBytes) {
      throw Error(ErrorId::kSceneTooLarge, "{} bytes; the limit is {}", value, kMaxFileBytes);
    }
    for (size_t i = 0; i < 4; ++i) {
      bytes[offset + i] = static_cast<unsigned char>(value >> (8 * i) & 0xff);
    }
  };
  const size_t length = word(bytes, 12);
  setWord(8, word(bytes, 8) - length + text.size());
  setWord(12, text.size());
  const auto begin = bytes.begin() + kHeader;
  bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
  bytes.insert(bytes.begin() + kHeader, text.begin(), text.end());
}

}  // namespace

void readModel(const std::string& path, tinygltf::Model& model, std::vector<std::string>& notes) {
  Bytes bytes = readFile(path, "", kMaxFileBytes, ErrorId::kSceneUnreadable);
  if (bytes.empty()) throw Error(ErrorId::kSceneUnreadable, "the file is empty");
  Files files{.folder = std::filesystem::path(path).parent_path()};
  Adaptation adaptation;
  {
    json document = parseJson(jsonOf(bytes));
    checkAsset(document);
    checkExtensions(document, notes);
    checkSizes(document);
    if (adaptation.apply(document)) replaceJson(bytes, document);
    files.buffersLeft = externalBuffers(document);
  }
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keepImage, nullptr);
  loader.SetFsCallbacks(callbacksFor<tinygltf::FsCallbacks>(files));
  std::string error, warning;
  bool good = false;
  const auto size = static_cast<unsigned>(bytes.size());
  try {
    good = isBinary(bytes)
               ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size)
               : loader.LoadASCIIFromString(&model, &error, &warning,
                                            reinterpret_cast<const char*>(bytes.data()), size, "");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  while (!error.empty() && error.back() == '\n') error.pop_back();
  if (!good || !error.empty()) throw Error(ErrorId::kSceneInvalid, "{}", error);
  adaptation.undo(model);
  decodeMeshopt(model);
  decodeDraco(model);
}

std::vector<std::byte> imageBytes(const std::string& path, const tinygltf::Model& model,
                                  int index) {
  if (index < 0 || static_cast<size_t>(index) >= model.images.size()) {
    throw Error(ErrorId::kSceneInvalid, "image {} does not exist", index);
  }
  const tinygltf::Image& image = model.images[static_cast<size_t>(index)];
  const auto copy = [](std::span<const unsigned char> from) {
    const auto bytes = std::as_bytes(from);
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  if (image.bufferView >= 0) return copy(viewBytes(model, image.bufferView));
  if (image.uri.empty()) return copy(image.image);
  const std::string name(image.image.begin(), image.image.end());
  const auto folder = std::filesystem::path(path).parent_path();
  return copy(readFile(besideScene(folder, name), name, kMaxFileBytes, ErrorId::kSceneImage));
}

}  // namespace grisaille::scene
