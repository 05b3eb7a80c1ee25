// SPDX-License-Identifier: MIT
#include "core/image/encode.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <limits>
#include <mutex>
#include <thread>

#include "core/base/error.h"

namespace grisaille::image {
namespace {

// IEC 61966-2-1.
double encodeSrgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

bool isAlpha(uint32_t channel, uint32_t channels) {
  return channels % 2 == 0 && channel + 1 == channels;
}

// libpng's state for one file. Errors arrive by longjmp(), which runs no destructors: encode() has
// no objects of its own.
class PngWriter {
 public:
  PngWriter() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) throw std::bad_alloc();
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  // channels: 1 to 4; bits: 8 or 16, in the machine's byte order
  std::vector<std::byte> encode(const void* pixels, uint32_t width, uint32_t height,
                                uint32_t channels, int bits, bool srgb) {
    constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                              PNG_COLOR_TYPE_RGB_ALPHA};
    const size_t row = size_t{width} * channels * static_cast<size_t>(bits / 8);
    const auto* bytes = static_cast<const png_byte*>(pixels);
    if (setjmp(png_jmpbuf(png_)) != 0) {
      throw Error(ErrorId::kFileUnwritable, "the PNG encoder fails: {}", error_);
    }
    png_set_write_fn(png_, this, onBytes, nullptr);
    png_set_IHDR(png_, info_, width, height, bits, kTypes[channels - 1], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (srgb) png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_ABSOLUTE);
    png_write_info(png_, info_);
    if (bits == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
    for (uint32_t y = 0; y < height; ++y) png_write_row(png_, bytes + y * row);
    png_write_end(png_, info_);
    return std::move(out_);
  }

 private:
  [[noreturn]] static void onError(png_structp png, png_const_charp text) {
    static_cast<PngWriter*>(png_get_error_ptr(png))->error_ = text;
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void onBytes(png_structp png, png_bytep bytes, size_t count) {
    auto* self = static_cast<PngWriter*>(png_get_io_ptr(png));
    const auto* from = reinterpret_cast<const std::byte*>(bytes);
    bool stored = false;
    try {
      self->out_.insert(self->out_.end(), from, from + count);
      stored = true;
    } catch (const std::bad_alloc&) {  // no exception may pass through libpng
    }
    if (!stored) png_error(png, "out of memory");
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string error_;
  std::vector<std::byte> out_;
};

// A file of OpenEXR in memory: writing to a disk that is full would not be reported.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("picture") {}

  void write(const char* from, int count) override {
    const auto size = static_cast<size_t>(count);
    bytes_.resize(std::max(bytes_.size(), at_ + size));
    std::memcpy(bytes_.data() + at_, from, size);
    at_ += size;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t at) override { at_ = at; }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  uint64_t at_ = 0;
};

Imath::M44f matrixOf(const std::array<float, 16>& from) {
  Imath::M44f matrix;
  std::copy(from.begin(), from.end(), matrix.getValue());
  return matrix;
}

}  // namespace

template <typename Integer>
std::vector<Integer> quantise(const Image& image, Transfer transfer) {
  constexpr double kLargest = std::numeric_limits<Integer>::max();
  std::vector<Integer> result(image.pixels.size());
  for (size_t i = 0; i < result.size(); ++i) {
    const float stored = image.pixels[i];
    const double shown = transfer == Transfer::kSigned ? (double{stored} + 1) / 2 : double{stored};
    double value = std::isnan(shown) ? 0.0 : std::clamp(shown, 0.0, 1.0);
    const auto channel = static_cast<uint32_t>(i % image.channels);
    if (transfer == Transfer::kColour && !isAlpha(channel, image.channels)) {
      value = encodeSrgb(value);
    }
    result[i] = static_cast<Integer>(std::lround(value * kLargest));
  }
  return result;
}
template std::vector<uint8_t> quantise<uint8_t>(const Image& image, Transfer transfer);
template std::vector<uint16_t> quantise<uint16_t>(const Image& image, Transfer transfer);

std::vector<std::byte> pngOf(const Image& image, const WriteOptions& options) {
  const bool srgb = options.transfer == Transfer::kColour;
  const auto encode = [&](const auto& pixels, int bits) {
    return PngWriter().encode(pixels.data(), image.width, image.height, image.channels, bits, srgb);
  };
  return options.pngBits == 16 ? encode(quantise<uint16_t>(image, options.transfer), 16)
                               : encode(quantise<uint8_t>(image, options.transfer), 8);
}

std::vector<std::byte> encodePng(const Image8& image) {
  return PngWriter().encode(image.pixels.data(), image.width, image.height, 4, 8, false);
}

std::vector<std::byte> exrOf(const Image& image, const WriteOptions& options) {
  static std::once_flag threads;
  std::call_once(threads, [] {
    Imf::setGlobalThreadCount(static_cast<int>(std::min(8u, std::thread::hardware_concurrency())));
  });
  constexpr const char* kNames[] = {"Y", "",  "",  "", "R", "G", "",  "",
                                    "R", "G", "B", "", "R", "G", "B", "A"};
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  if (options.matrices) {
    Imf::addWorldToCamera(header, matrixOf(options.matrices->worldToCamera));
    Imf::addWorldToNDC(header, matrixOf(options.matrices->worldToNdc));
  }
  Imf::FrameBuffer pixels;
  const size_t stride = sizeof(float) * image.channels;
  for (uint32_t c = 0; c < image.channels; ++c) {
    const char* name = kNames[(image.channels - 1) * 4 + c];
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR's slices are writable; the file writes nothing to them.
    auto* first = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + c));
    pixels.insert(name, Imf::Slice(Imf::FLOAT, first, stride, stride * image.width));
  }
  MemoryStream stream;
  try {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(pixels);
    file.writePixels(static_cast<int>(image.height));
  } catch (const std::exception& error) {
    throw Error(ErrorId::kFileUnwritable, "the EXR encoder fails: {}", error.what());
  }
  return stream.take();
}

}  // namespace grisaille::image
