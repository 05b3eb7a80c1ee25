// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"

namespace grisaille::image {
namespace {

constexpr uint32_t kWidth = 21, kHeight = 13;

// One of the kinds of PNG that the specification allows (W3C, "PNG Specification", 3rd edition,
// table 12).
struct Kind {
  int type, bits;
  bool interlaced, transparent;  // transparent: with a tRNS chunk
};

std::vector<Kind> allKinds() {
  std::vector<Kind> kinds;
  const auto add = [&](int type, std::initializer_list<int> depths, bool transparency) {
    for (const int bits : depths) {
      for (const bool interlaced : {false, true}) {
        kinds.push_back({type, bits, interlaced, false});
        if (transparency) kinds.push_back({type, bits, interlaced, true});
      }
    }
  };
  add(PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}, true);
  add(PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}, true);
  add(PNG_COLOR_TYPE_RGB, {8, 16}, true);
  add(PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}, false);
  add(PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}, false);
  return kinds;
}

int channelsOf(int type) {
  return type == PNG_COLOR_TYPE_GRAY || type == PNG_COLOR_TYPE_PALETTE ? 1
         : type == PNG_COLOR_TYPE_GRAY_ALPHA                           ? 2
         : type == PNG_COLOR_TYPE_RGB                                  ? 3
                                                                       : 4;
}

// Samples of a picture, and its palette.
struct Samples {
  std::vector<uint32_t> values;
  std::array<std::array<uint8_t, 4>, 256> palette{};
};

Samples samplesOf(const Kind& kind) {
  std::mt19937 random(7);
  Samples samples;
  const uint32_t most = (1u << kind.bits) - 1;
  for (size_t i = 0; i < size_t{kWidth} * kHeight * channelsOf(kind.type); ++i) {
    samples.values.push_back(static_cast<uint32_t>(random()) & most);
  }
  for (auto& colour : samples.palette) {
    for (uint8_t& value : colour) value = static_cast<uint8_t>(random());
  }
  return samples;
}

// What a pixel becomes with 8 bits per channel.
std::array<int, 4> expected(const Kind& kind, const Samples& samples, size_t pixel) {
  const size_t channels = static_cast<size_t>(channelsOf(kind.type));
  const uint32_t* in = &samples.values[pixel * channels];
  if (kind.type == PNG_COLOR_TYPE_PALETTE) {
    const auto& colour = samples.palette[in[0]];
    return {colour[0], colour[1], colour[2], kind.transparent ? colour[3] : 255};
  }
  const double most = (1u << kind.bits) - 1;
  const auto to8 = [&](uint32_t value) {
    return static_cast<int>(std::lround(value / most * 255));
  };
  const bool grey = channels < 3;
  // The tRNS chunk names the colour of the first pixel.
  const bool hidden = kind.transparent && std::equal(in, in + channels, samples.values.begin());
  const int alpha = channels % 2 == 0 ? to8(in[channels - 1]) : hidden ? 0 : 255;
  return {to8(in[0]), to8(in[grey ? 0 : 1]), to8(in[grey ? 0 : 2]), alpha};
}

// Each sample of a row in `bits` bits, the first in the highest: section 7.2 of the specification.
std::vector<png_byte> packed(std::span<const uint32_t> values, int bits) {
  std::vector<png_byte> row((values.size() * static_cast<size_t>(bits) + 7) / 8);
  for (size_t i = 0; i < values.size(); ++i) {
    const size_t at = i * static_cast<size_t>(bits);
    if (bits == 16) {
      row[at / 8] = static_cast<png_byte>(values[i] >> 8);
      row[at / 8 + 1] = static_cast<png_byte>(values[i]);
    } else {
      row[at / 8] |= static_cast<png_byte>(values[i] << (8 - bits - static_cast<int>(at % 8)));
    }
  }
  return row;
}

std::vector<std::byte> encoded(const Kind& kind, const Samples& samples) {
  std::vector<std::byte> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp self, png_bytep from, size_t count) {
        auto* to = static_cast<std::vector<std::byte>*>(png_get_io_ptr(self));
        const auto view = std::as_bytes(std::span(from, count));
        to->insert(to->end(), view.begin(), view.end());
      },
      nullptr);
  png_set_IHDR(png, info, kWidth, kHeight, kind.bits, kind.type,
               kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> colours;
  std::vector<png_byte> alphas;
  for (size_t i = 0; i < size_t{1} << std::min(kind.bits, 8); ++i) {
    const auto& colour = samples.palette[i];
    colours.push_back({colour[0], colour[1], colour[2]});
    alphas.push_back(colour[3]);
  }
  if (kind.type == PNG_COLOR_TYPE_PALETTE) {
    png_set_PLTE(png, info, colours.data(), static_cast<int>(colours.size()));
    if (kind.transparent) {
      png_set_tRNS(png, info, alphas.data(), static_cast<int>(alphas.size()), nullptr);
    }
  } else if (kind.transparent) {
    const auto first = [&](size_t i) { return static_cast<png_uint_16>(samples.values[i]); };
    const bool grey = kind.type == PNG_COLOR_TYPE_GRAY;
    const png_color_16 hidden = {0, grey ? png_uint_16{0} : first(0),
                                 grey ? png_uint_16{0} : first(1), grey ? png_uint_16{0} : first(2),
                                 grey ? first(0) : png_uint_16{0}};
    png_set_tRNS(png, info, nullptr, 0, &hidden);
  }
  png_write_info(png, info);
  const size_t row = size_t{kWidth} * channelsOf(kind.type);
  std::vector<std::vector<png_byte>> rows;
  std::vector<png_bytep> pointers;
  for (size_t y = 0; y < kHeight; ++y) {
    rows.push_back(packed(std::span(samples.values).subspan(y * row, row), kind.bits));
    pointers.push_back(rows.back().data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

TEST(DecodePng, EveryKindOfTheSpecification) {
  for (const Kind& kind : allKinds()) {
    const Samples samples = samplesOf(kind);
    const std::vector<std::byte> bytes = encoded(kind, samples);
    const Image8 image = decode(bytes, "kind");
    const Alpha8 alpha = decodeAlpha(bytes, "kind");
    ASSERT_EQ(image.width, kWidth);
    ASSERT_EQ(image.height, kHeight);
    ASSERT_EQ(alpha.pixels.size(), size_t{kWidth} * kHeight);
    for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
      const std::array<int, 4> want = expected(kind, samples, i);
      const uint8_t* got = &image.pixels[i * 4];
      ASSERT_EQ((std::array<int, 4>{got[0], got[1], got[2], got[3]}), want)
          << "type " << kind.type << ", " << kind.bits << " bits, interlaced " << kind.interlaced
          << ", transparent " << kind.transparent << ", pixel " << i;
      ASSERT_EQ(alpha.pixels[i], want[3]);
    }
  }
}

TEST(DecodePng, TooLargeIsRefused) {
  Image8 wide{.width = 16385, .height = 1, .pixels = {}};
  wide.pixels.resize(size_t{wide.width} * 4);
  try {
    decode(encodePng(wide), "wide");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kSceneImage);
    EXPECT_NE(error.detail().find("16385 x 1 pixels, at most 16384"), std::string::npos)
        << error.detail();
  }
}

}  // namespace
}  // namespace grisaille::image
