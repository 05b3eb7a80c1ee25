// SPDX-License-Identifier: MIT
// Pictures in memory, in and out of files (through OpenImageIO), and how far two of them differ.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace grisaille::image {

// Rows from the top, channels interleaved.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t channels = 0;
  std::vector<float> pixels;  // width * height * channels

  float at(uint32_t x, uint32_t y, uint32_t channel = 0) const {
    return pixels[(size_t{y} * width + x) * channels + channel];
  }
};

// 8 bits a channel, RGBA, as stored (not linearised).
struct Image8 {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> pixels;  // width * height * 4
};

enum class Transfer : uint8_t {
  kData,    // numbers: files hold them as they are
  kColour,  // linear light: files of integers hold it sRGB encoded
  kSigned   // numbers from -1 to 1: files of integers hold (x + 1) / 2
};

// The camera of a picture as OpenEXR's standard attributes hold it: row after row, for points that
// are rows, so that the last row is what the origin goes to.
struct ViewMatrices {
  std::array<float, 16> worldToCamera{}, worldToNdc{};
};

struct WriteOptions {
  Transfer transfer = Transfer::kData;
  uint32_t pngBits = 8;                       // 8 or 16
  std::optional<ViewMatrices> matrices = {};  // for an EXR to hold
};

// By the name's ending: .exr holds 32-bit floats as they are, .png rounds to integers after
// clamping to [0, 1] (NaN: 0). Written aside, then renamed: a failure leaves no half file and an
// older file as it was. Throws kImageFormat, kFileUnwritable, kNoCodecs.
void write(const Image& image, const std::string& path, const WriteOptions& options = {});

// Throws kImageFormat when `path` has an ending that write() does not take, and kFileUnwritable
// where nothing can be written there: ask before long work.
void checkWritable(const std::string& path);

// How many values are NaN or infinite.
size_t countNonFinite(const Image& image);

// Any format OpenImageIO reads; integers become [0, 1]. Throws kImageUnreadable, kPictureDeep,
// kNoCodecs.
Image read(const std::string& path);

// A picture with what its file says of it.
struct Picture {
  Image image;
  std::vector<std::string> channels;  // names, as many as the image has
  std::optional<ViewMatrices> matrices;
};

// As read(). Throws kPictureSize as well, where the file holds a part of its picture, or more.
Picture readPicture(const std::string& path);

// A PNG or JPEG in memory, of at most 16384 pixels a side. `name` is for messages. Throws
// kSceneImage, kNoCodecs.
Image8 decode(std::span<const std::byte> encoded, const std::string& name);

// A PNG of 8 bits a channel, RGBA, in memory.
std::vector<std::byte> encodePng(const Image8& image);

// A JPEG in memory of one or three channels of numbers, as write() rounds them; quality 1 ... 100.
std::vector<std::byte> encodeJpeg(const Image& image, int quality);

// The number that holds for two images of one size and channel count. Pixels where either is not
// finite count apart.
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

// Share of values that differ by more than `threshold`. A value that is not finite differs from all
// but its like. Throws kImageMismatch.
double shareOver(const Image& a, const Image& b, double threshold);

struct Similarity {
  double mean = 1;       // -1 ... 1; 1: equal, and where no window is left
  uint64_t windows = 0;  // that the mean is over
  uint64_t leftOut = 0;  // windows that hold a pixel which is not finite
};

// Mean structural similarity of pictures of one channel and the range 0 ... 1: Wang, Bovik, Sheikh
// and Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE
// Transactions on Image Processing 13(4), 2004. A Gaussian window of 11 x 11 pixels, sigma 1.5,
// K1 = 0.01, K2 = 0.03. As in the authors' ssim_index.m, only windows that lie whole in the picture
// count, and the picture is not made smaller first. Throws kImageMismatch.
Similarity ssim(const Image& a, const Image& b);

}  // namespace grisaille::image
