// SPDX-License-Identifier: MIT
#include "core/image/image.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/library_folder.h"
#include "core/image/codecs.h"
#include "core/image/decode_png.h"
#include "core/image/encode.h"

namespace grisaille::image {
namespace {

enum class Format : uint8_t { kExr, kPng };

Format formatOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending == ".exr") return Format::kExr;
  if (ending == ".png") return Format::kPng;
  throw Error(ErrorId::kImageFormat, "{}: the ending \"{}\" names no format that is written", path,
              ending);
}

const Codecs& codecs() {
  static const Codecs& loaded = []() -> const Codecs& {
    // The library stays loaded until the process ends.
    const std::string file = libraryFolder() / "libgrisaille_codecs.so";
    void* library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* function = library != nullptr ? dlsym(library, kCodecsFunction) : nullptr;
    if (function == nullptr) {
      throw Error(ErrorId::kNoCodecs, "cannot load the picture codecs: {}", dlerror());
    }
    return *reinterpret_cast<CodecsOf*>(function)();
  }();
  return loaded;
}

}  // namespace

void checkWritable(const std::string& path) {
  formatOf(path);
  requireWritable(path);
}

size_t countNonFinite(const Image& image) {
  const auto odd = [](float value) { return !std::isfinite(value); };
  return static_cast<size_t>(std::ranges::count_if(image.pixels, odd));
}

void write(const Image& image, const std::string& path, const WriteOptions& options) {
  const Format format = formatOf(path);
  const uint64_t values = uint64_t{image.width} * image.height * image.channels;
  if (values == 0 || values != image.pixels.size() || image.channels > 4) {
    throw Error(ErrorId::kImageMismatch, "{}: {} values for {} x {} pixels of {} channels", path,
                image.pixels.size(), image.width, image.height, image.channels);
  }
  if (format == Format::kPng && options.pngBits != 8 && options.pngBits != 16) {
    throw Error(ErrorId::kImageFormat, "{}: a PNG cannot have {} bits, only 8 or 16", path,
                options.pngBits);
  }
  const std::vector<std::byte> bytes =
      format == Format::kExr ? exrOf(image, options) : pngOf(image, options);
  writeFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Image read(const std::string& path) {
  return codecs().read(path);
}

Picture readPicture(const std::string& path) {
  return codecs().readPicture(path);
}

Image8 decode(std::span<const std::byte> encoded, const std::string& name) {
  return isPng(encoded) ? decodePng(encoded, name) : codecs().decode(encoded, name);
}

Alpha8 decodeAlpha(std::span<const std::byte> encoded, const std::string& name) {
  return isPng(encoded) ? decodePngAlpha(encoded, name) : codecs().decodeAlpha(encoded, name);
}

std::vector<std::byte> encodeJpeg(const Image& image, int quality) {
  return codecs().encodeJpeg(quantise<uint8_t>(image, Transfer::kData), image.width, image.height,
                             image.channels, quality);
}

}  // namespace grisaille::image
