// SPDX-License-Identifier: MIT
// Pictures in memory, reading and writing of picture files, and image metrics.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grisaille::image {

// Top row first, channels interleaved.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t channels = 0;
  std::vector<float> pixels;  // width * height * channels

  float at(uint32_t x, uint32_t y, uint32_t channel = 0) const {
    return pixels[(size_t{y} * width + x) * channels + channel];
  }
};

// RGBA, 8 bits per channel, as stored (not linearised).
struct Image8 {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> pixels;  // width * height * 4
};

// One channel, 8 bits.
struct Alpha8 {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> pixels;  // width * height
};

enum class Transfer : uint8_t {
  kData,    // numbers, stored unchanged
  kColour,  // linear light; files of integers store it with sRGB encoding
  kSigned   // numbers from -1 to 1; files of integers store (x + 1) / 2
};

// The camera of a picture, from OpenEXR's standard attributes: row-major, for row vectors, so that
// the last row is the image of the origin.
struct ViewMatrices {
  std::array<float, 16> worldToCamera{}, worldToNdc{};
};

struct WriteOptions {
  Transfer transfer = Transfer::kData;
  uint32_t pngBits = 8;                       // 8 or 16
  std::optional<ViewMatrices> matrices = {};  // stored in an EXR file; ignored for PNG
};

// Writes a file whose format the name's ending selects: .exr stores 32-bit floats unchanged, .png
// clamps to [0, 1] (NaN: 0) and rounds to integers. The write is atomic: a failure leaves no
// partial file and an older file unchanged. Throws kImageFormat, kImageMismatch, kFileUnwritable.
void write(const Image& image, const std::string& path, const WriteOptions& options = {});

// Checks, before long work, that write() can write to `path`. Throws kImageFormat for an ending
// that write() does not support, and kFileUnwritable.
void checkWritable(const std::string& path);

// Number of values that are NaN or infinite.
size_t countNonFinite(const Image& image);

// Reads any format that OpenImageIO reads; integers become [0, 1]. Throws kImageUnreadable,
// kPictureDeep, kNoCodecs.
Image read(const std::string& path);

// A picture with the metadata of its file.
struct Picture {
  Image image;
  std::vector<std::string> channels;  // names, one per channel of the image
  std::optional<ViewMatrices> matrices;
  bool integers = false;  // whether the file stores integers
};

// The same as read(), with metadata. Also throws kPictureSize if the data window of the file
// differs from its display window, and kPictureAspect if its pixels are not square.
Picture readPicture(const std::string& path);

// Decodes a PNG, JPEG or WebP in memory, of at most 16384 pixels per side. `name` is for messages.
// Throws kSceneImage, kNoCodecs.
Image8 decode(std::span<const std::byte> encoded, const std::string& name);

// The same for the alpha channel alone; 255 without one. Needs a quarter of the memory.
Alpha8 decodeAlpha(std::span<const std::byte> encoded, const std::string& name);

// Encodes a PNG in memory, RGBA with 8 bits per channel.
std::vector<std::byte> encodePng(const Image8& image);

// Encodes a JPEG in memory, of one or three channels of numbers, rounded the same as in write().
// `quality`: 1 to 100.
std::vector<std::byte> encodeJpeg(const Image& image, int quality);

// Error metrics of two images of the same size and channel count. Values that are not finite in
// either image are left out and counted separately.
struct Difference {
  uint64_t compared = 0;   // values
  uint64_t nonFinite = 0;  // values left out
  double rmse = 0;
  double meanAbsolute = 0;
  double bias = 0;  // mean of a - b
  double largest = 0;
  double percentile99 = 0;  // of the absolute difference
};

// Throws kImageMismatch.
Difference compare(const Image& a, const Image& b);

// Share of values that differ by more than `threshold`. Infinity equals only the same infinity, and
// NaN only NaN; all other pairs with a value that is not finite differ. Throws kImageMismatch.
double shareOver(const Image& a, const Image& b, double threshold);

struct Similarity {
  double mean = 1;       // -1 to 1; 1: equal images, or no window counts
  uint64_t windows = 0;  // number of windows in the mean
  uint64_t leftOut = 0;  // number of windows with a pixel that is not finite
};

// Mean structural similarity of images with one channel and the range 0 to 1: Wang, Bovik, Sheikh
// and Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE
// Transactions on Image Processing 13(4), 2004. A Gaussian window of 11 x 11 pixels, sigma 1.5,
// K1 = 0.01, K2 = 0.03. Same as in the authors' ssim_index.m, only windows that lie entirely inside
// the image count, and the image is not downsampled first. Throws kImageMismatch.
Similarity ssim(const Image& a, const Image& b);

}  // namespace grisaille::image
