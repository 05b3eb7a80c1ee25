// SPDX-License-Identifier: MIT
#include "core/image/decode_png.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <new>

#include "core/base/error.h"
#include "core/image/codecs.h"

namespace grisaille::image {
namespace {

// libpng's state for one file, whose rows it converts to RGBA with 8 bits per channel. Errors
// arrive by longjmp(), which runs no destructors: the functions that call setjmp() have no objects
// of their own.
class PngReader {
 public:
  PngReader(std::span<const std::byte> encoded, const std::string& name)
      : left_(encoded), name_(name) {}
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  // Reads the file's head. Call it once, before all else; a constructor that throws would leave
  // libpng's state behind.
  void begin() {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) throw std::bad_alloc();
    if (!open()) fail();
    if (std::max(width_, height_) > uint32_t{kLargestSide}) {
      throw Error(ErrorId::kSceneImage, "image \"{}\": {} x {} pixels, at most {} a side", name_,
                  width_, height_, kLargestSide);
    }
    // The rows of an interlaced file are complete after its last pass: all are kept until then.
    pixels_.resize(rowBytes() * (passes_ > 1 ? height_ : 1));
  }

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  size_t rowBytes() const { return size_t{width_} * 4; }

  // Calls `take(row)` for each row, from the top.
  template <typename Take>
  void eachRow(Take&& take) {
    for (int pass = 0; pass + 1 < passes_; ++pass) {
      for (uint32_t y = 0; y < height_; ++y) readRow(&pixels_[y * rowBytes()]);
    }
    for (uint32_t y = 0; y < height_; ++y) {
      uint8_t* row = &pixels_[passes_ > 1 ? y * rowBytes() : 0];
      readRow(row);
      take(row);
    }
    if (!readEnd()) fail();
  }

 private:
  bool open() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // the caller checks them
    png_set_read_fn(png_, this, onRead);
    png_read_info(png_, info_);
    width_ = png_get_image_width(png_, info_);
    height_ = png_get_image_height(png_, info_);
    png_set_expand(png_);
    png_set_scale_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  void readRow(uint8_t* row) {
    if (!readRowOrFail(row)) fail();
  }
  bool readRowOrFail(uint8_t* row) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row, nullptr);
    return true;
  }
  bool readEnd() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_end(png_, nullptr);
    return true;
  }
  [[noreturn]] void fail() const {
    throw Error(ErrorId::kSceneImage, "image \"{}\": {}", name_, error_);
  }

  [[noreturn]] static void onError(png_structp png, png_const_charp text) {
    auto* self = static_cast<PngReader*>(png_get_error_ptr(png));
    // No exception may pass through libpng.
    std::strncpy(self->error_, text, sizeof self->error_ - 1);
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void onRead(png_structp png, png_bytep to, size_t count) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self->left_.size()) png_error(png, "the PNG is cut short");
    std::memcpy(to, self->left_.data(), count);
    self->left_ = self->left_.subspan(count);
  }

  std::span<const std::byte> left_;  // not read yet
  const std::string& name_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  uint32_t width_ = 0, height_ = 0;
  int passes_ = 1;
  std::vector<uint8_t> pixels_;  // RGBA
  char error_[200] = "";
};

}  // namespace

bool isPng(std::span<const std::byte> encoded) {
  constexpr size_t kSignature = 8;  // bytes
  return encoded.size() >= kSignature &&
         png_sig_cmp(reinterpret_cast<png_const_bytep>(encoded.data()), 0, kSignature) == 0;
}

Image8 decodePng(std::span<const std::byte> encoded, const std::string& name) {
  PngReader reader(encoded, name);
  reader.begin();
  Image8 image{.width = reader.width(), .height = reader.height(), .pixels = {}};
  image.pixels.reserve(reader.rowBytes() * image.height);
  reader.eachRow([&](const uint8_t* row) {
    image.pixels.insert(image.pixels.end(), row, row + reader.rowBytes());
  });
  return image;
}

Alpha8 decodePngAlpha(std::span<const std::byte> encoded, const std::string& name) {
  PngReader reader(encoded, name);
  reader.begin();
  Alpha8 alpha{.width = reader.width(), .height = reader.height(), .pixels = {}};
  alpha.pixels.reserve(size_t{alpha.width} * alpha.height);
  reader.eachRow([&](const uint8_t* row) {
    for (uint32_t x = 0; x < alpha.width; ++x) alpha.pixels.push_back(row[x * 4 + 3]);
  });
  return alpha;
}

}  // namespace grisaille::image
