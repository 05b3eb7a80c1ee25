// SPDX-License-Identifier: MIT
#include "core/image/codecs.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::image {
namespace {

constexpr uint64_t kMostValues = uint64_t{1} << 29;

// Redirects the process's standard error to /dev/null for its lifetime: libpng prints each error,
// although OpenImageIO reports it too, and printing cannot be disabled. Lifetimes in several
// threads may overlap.
class SilentStderr {
 public:
  SilentStderr() {
    const std::lock_guard lock(mutex_);
    if (users_++ > 0) return;
    std::fflush(stderr);
    saved_ = dup(STDERR_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~SilentStderr() {
    const std::lock_guard lock(mutex_);
    if (--users_ > 0 || saved_ < 0) return;
    std::fflush(stderr);
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  SilentStderr(const SilentStderr&) = delete;
  SilentStderr& operator=(const SilentStderr&) = delete;

 private:
  static inline std::mutex mutex_;
  static inline int users_ = 0;
  static inline int saved_ = -1;
};

// OpenImageIO keeps errors in two places and prints errors that the caller does not fetch: fetch
// both.
template <typename Stream>
std::string errorOf(const Stream* stream) {
  std::string text = stream ? stream->geterror() : std::string();
  const std::string global = OIIO::geterror();
  if (text.empty()) text = global;
  return text.empty() ? "no reason is known" : text;
}

// OpenImageIO's names of OpenEXR's worldToCamera and worldToNDC.
constexpr const char* kWorldToCamera = "worldtocamera";
constexpr const char* kWorldToNdc = "worldtoNDC";

std::optional<ViewMatrices> matricesOf(const OIIO::ImageSpec& spec) {
  ViewMatrices matrices;
  if (!spec.getattribute(kWorldToCamera, OIIO::TypeMatrix, matrices.worldToCamera.data()) ||
      !spec.getattribute(kWorldToNdc, OIIO::TypeMatrix, matrices.worldToNdc.data())) {
    return std::nullopt;
  }
  return matrices;
}

OIIO::ImageSpec readConfig() {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  return config;
}

bool endsLikeJpeg(std::span<const std::byte> bytes) {
  // A truncated file decodes to grey without an error: look for the end marker. Some writers pad.
  const size_t from = bytes.size() > 64 ? bytes.size() - 64 : 0;
  for (size_t i = from; i + 1 < bytes.size(); ++i) {
    if (bytes[i] == std::byte{0xff} && bytes[i + 1] == std::byte{0xd9}) return true;
  }
  return false;
}

const char* pluginFor(std::span<const std::byte> encoded, const std::string& name) {
  constexpr unsigned char kJpeg[] = {0xff, 0xd8, 0xff};
  if (encoded.size() >= sizeof kJpeg && std::memcmp(encoded.data(), kJpeg, sizeof kJpeg) == 0) {
    if (endsLikeJpeg(encoded)) return "jpeg";
    throw Error(ErrorId::kSceneImage, "image \"{}\": the JPEG is cut short", name);
  }
  if (encoded.size() >= 12 && std::memcmp(encoded.data(), "RIFF", 4) == 0 &&
      std::memcmp(&encoded[8], "WEBP", 4) == 0) {
    return "webp";
  }
  throw Error(ErrorId::kSceneImage, "image \"{}\": neither a PNG nor a JPEG nor a WebP", name);
}

// Converts grey, grey with alpha, RGB or RGBA to RGBA.
void toRgba(const std::vector<uint8_t>& from, size_t channels, uint8_t* out) {
  for (size_t i = 0; i < from.size(); i += channels, out += 4) {
    const uint8_t* in = &from[i];
    const bool grey = channels < 3;
    out[0] = in[0];
    out[1] = grey ? in[0] : in[1];
    out[2] = grey ? in[0] : in[2];
    out[3] = channels == 2 ? in[1] : channels == 4 ? in[3] : uint8_t{255};
  }
}

std::unique_ptr<OIIO::ImageInput> openPicture(const std::string& path) {
  requireRegularFile(path, ErrorId::kImageUnreadable);
  const OIIO::ImageSpec config = readConfig();
  auto input = OIIO::ImageInput::open(path, &config);
  if (!input) {
    throw Error(ErrorId::kImageUnreadable, "{}: {}", path,
                errorOf(static_cast<OIIO::ImageInput*>(nullptr)));
  }
  if (input->spec().deep) {
    throw Error(ErrorId::kPictureDeep,
                "{}: it is a deep picture, with a variable number of samples per pixel", path);
  }
  return input;
}

Image pixelsOf(OIIO::ImageInput& input, const std::string& path) {
  const OIIO::ImageSpec& spec = input.spec();
  const uint64_t values = spec.image_pixels() * static_cast<uint64_t>(spec.nchannels);
  if (spec.width > kLargestSide || spec.height > kLargestSide || values > kMostValues ||
      values == 0) {
    throw Error(ErrorId::kImageUnreadable, "{}: {} x {} pixels of {} channels are out of range",
                path, spec.width, spec.height, spec.nchannels);
  }
  Image image{.width = static_cast<uint32_t>(spec.width),
              .height = static_cast<uint32_t>(spec.height),
              .channels = static_cast<uint32_t>(spec.nchannels),
              .pixels = std::vector<float>(values)};
  if (!input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    throw Error(ErrorId::kImageUnreadable, "{}: {}", path, errorOf(&input));
  }
  return image;
}

Image read(const std::string& path) {
  const SilentStderr silent;
  const auto input = openPicture(path);
  return pixelsOf(*input, path);
}

Picture readPicture(const std::string& path) {
  const SilentStderr silent;
  const auto input = openPicture(path);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height) {
    throw Error(ErrorId::kPictureSize,
                "{}: it holds {} x {} pixels at ({}, {}) of a picture of {} x {}", path, spec.width,
                spec.height, spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width,
                spec.full_height);
  }
  const float aspect = spec.get_float_attribute("PixelAspectRatio", 1);
  if (!(std::abs(aspect - 1) < 0.001f)) {
    throw Error(ErrorId::kPictureAspect, "{}: its pixels have an aspect ratio of {:.4g}, not 1",
                path, aspect);
  }
  return {.image = pixelsOf(*input, path),
          .channels = spec.channelnames,
          .matrices = matricesOf(spec),
          .integers = !spec.format.is_floating_point()};
}

// An encoded image in memory, opened, of checked size.
class Decoder {
 public:
  Decoder(std::span<const std::byte> encoded, const std::string& name)
      : name_(name), memory_(encoded.data(), encoded.size()) {
    const char* plugin = pluginFor(encoded, name);
    input_ = OIIO::ImageInput::create(plugin);
    if (!input_ || !input_->set_ioproxy(&memory_) || !input_->open(plugin, spec_, readConfig())) {
      fail();
    }
    if (spec_.width < 1 || spec_.height < 1 || spec_.width > kLargestSide ||
        spec_.height > kLargestSide || spec_.nchannels < 1 || spec_.nchannels > 4) {
      throw Error(ErrorId::kSceneImage,
                  "image \"{}\": {} x {} pixels of {} channels, at most {} a side", name,
                  spec_.width, spec_.height, spec_.nchannels, kLargestSide);
    }
  }

  uint32_t width() const { return static_cast<uint32_t>(spec_.width); }
  uint32_t height() const { return static_cast<uint32_t>(spec_.height); }
  size_t channels() const { return static_cast<size_t>(spec_.nchannels); }

  // Calls `take(y, pixels)` for rows from the top, several at a time: `pixels` has whole rows.
  // Reads few rows at once, since OpenImageIO holds another copy of what it reads.
  template <typename Take>
  void eachStrip(Take&& take) {
    constexpr size_t kStrip = size_t{1} << 24;  // bytes
    const size_t row = width() * channels();
    const auto rows = static_cast<int>(std::max<size_t>(1, kStrip / row));
    std::vector<uint8_t> pixels;
    for (int y = 0; y < spec_.height; y += rows) {
      const int end = std::min(spec_.height, y + rows);
      pixels.resize(static_cast<size_t>(end - y) * row);
      if (!input_->read_scanlines(0, 0, y, end, 0, 0, spec_.nchannels, OIIO::TypeDesc::UINT8,
                                  pixels.data())) {
        fail();
      }
      take(static_cast<size_t>(y), pixels);
    }
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ErrorId::kSceneImage, "image \"{}\": {}", name_, errorOf(input_.get()));
  }

  const SilentStderr silent_;
  const std::string& name_;
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

Image8 decode(std::span<const std::byte> encoded, const std::string& name) {
  Decoder decoder(encoded, name);
  Image8 image{.width = decoder.width(),
               .height = decoder.height(),
               .pixels = std::vector<uint8_t>(size_t{decoder.width()} * decoder.height() * 4)};
  decoder.eachStrip([&](size_t y, const std::vector<uint8_t>& pixels) {
    toRgba(pixels, decoder.channels(), &image.pixels[y * image.width * 4]);
  });
  return image;
}

Alpha8 decodeAlpha(std::span<const std::byte> encoded, const std::string& name) {
  Decoder decoder(encoded, name);
  const size_t channels = decoder.channels();
  Alpha8 alpha{.width = decoder.width(),
               .height = decoder.height(),
               .pixels = std::vector<uint8_t>(size_t{decoder.width()} * decoder.height(), 255)};
  decoder.eachStrip([&](size_t y, const std::vector<uint8_t>& pixels) {
    if (channels % 2 != 0) return;
    uint8_t* to = &alpha.pixels[y * alpha.width];
    for (size_t i = channels - 1; i < pixels.size(); i += channels) *to++ = pixels[i];
  });
  return alpha;
}

std::vector<std::byte> encodeJpeg(const std::vector<uint8_t>& pixels, uint32_t width,
                                  uint32_t height, uint32_t channels, int quality) {
  const SilentStderr silent;
  OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height),
                       static_cast<int>(channels), OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("jpeg");
  if (!output || !output->set_ioproxy(&memory) || !output->open("jpeg", spec) ||
      !output->write_image(spec.format, pixels.data()) || !output->close()) {
    throw Error(ErrorId::kFileUnwritable, "the JPEG encoder fails: {}", errorOf(output.get()));
  }
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

constexpr Codecs kCodecs = {read, readPicture, decode, decodeAlpha, encodeJpeg};

}  // namespace
}  // namespace grisaille::image

extern "C" __attribute__((visibility("default"))) grisaille::image::CodecsOf grisaille_codecs;

const grisaille::image::Codecs* grisaille_codecs() {
  return &grisaille::image::kCodecs;
}
