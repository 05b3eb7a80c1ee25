// SPDX-License-Identifier: MIT
#include "core/image/image.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "tests/support/expect_error.h"

namespace grisaille::image {
namespace {

namespace fs = std::filesystem;

class ImageFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("grisaille_image_" + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<std::byte> bytesOf(const std::string& path) const {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    return {data, data + text.size()};
  }

  fs::path folder_;
};

Image noiseIn(uint32_t channels, float low, float high) {
  std::mt19937 random(channels);
  Image image{.width = 37, .height = 23, .channels = channels, .pixels = {}};
  image.pixels.resize(size_t{image.width} * image.height * channels);
  for (float& value : image.pixels) {
    value = low + (high - low) * static_cast<float>(random() % 65536) / 65535.0f;
  }
  return image;
}

// IEC 61966-2-1, in the opposite direction to the code under test.
double toLinear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

TEST_F(ImageFiles, ExrKeepsEveryBit) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    Image image = noiseIn(channels, -1e4f, 1e4f);
    image.pixels[0] = std::numeric_limits<float>::infinity();
    image.pixels[1] = 1e-40f;
    image.pixels[2] = std::numeric_limits<float>::quiet_NaN();
    write(image, file("a.exr"), {.transfer = Transfer::kColour});
    const Image back = read(file("a.exr"));
    ASSERT_EQ(back.width, image.width);
    ASSERT_EQ(back.height, image.height);
    ASSERT_EQ(back.channels, channels);
    EXPECT_EQ(
        std::memcmp(back.pixels.data(), image.pixels.data(), image.pixels.size() * sizeof(float)),
        0)
        << channels;
  }
}

TEST_F(ImageFiles, PngRoundsDataToTheNearestStep) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    for (const uint32_t bits : {8u, 16u}) {
      const Image image = noiseIn(channels, 0, 1);
      write(image, file("a.PNG"), {.pngBits = bits});
      const Image back = read(file("a.PNG"));
      ASSERT_EQ(back.channels, channels);
      EXPECT_LE(compare(image, back).largest, 0.5 / ((1 << bits) - 1) + 1e-7) << channels << bits;
    }
  }
}

TEST_F(ImageFiles, PngEncodesColourButNeverAlpha) {
  for (const uint32_t channels : {1u, 3u, 4u}) {
    const Image image = noiseIn(channels, 0, 1);
    write(image, file("a.png"), {.transfer = Transfer::kColour, .pngBits = 16});
    Image back = read(file("a.png"));
    for (size_t i = 0; i < back.pixels.size(); ++i) {
      const bool alpha = channels == 4 && i % 4 == 3;
      if (!alpha) back.pixels[i] = static_cast<float>(toLinear(back.pixels[i]));
    }
    EXPECT_LE(compare(image, back).largest, 4e-5) << channels;
  }
}

TEST_F(ImageFiles, PngHoldsSignedNumbersAboutTheMiddle) {
  const Image image = noiseIn(3, -1, 1);
  write(image, file("a.png"), {.transfer = Transfer::kSigned, .pngBits = 16});
  Image back = read(file("a.png"));
  for (float& value : back.pixels) value = 2 * value - 1;
  EXPECT_LE(compare(image, back).largest, 1.0 / 65535 + 1e-6);
}

TEST_F(ImageFiles, PngClampsAndHasNoNan) {
  const Image image{
      .width = 5,
      .height = 1,
      .channels = 1,
      .pixels = {-3, 7, std::numeric_limits<float>::quiet_NaN(),
                 std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}};
  write(image, file("a.png"));
  EXPECT_EQ(read(file("a.png")).pixels, (std::vector<float>{0, 1, 0, 1, 0}));
}

TEST_F(ImageFiles, RowsRunFromTheTop) {
  const Image image{.width = 1, .height = 2, .channels = 1, .pixels = {1, 0}};
  write(image, file("a.png"));
  const Image8 decoded = decode(bytesOf(file("a.png")), "a");
  EXPECT_EQ(decoded.pixels, (std::vector<uint8_t>{255, 255, 255, 255, 0, 0, 0, 255}));
}

TEST_F(ImageFiles, OtherEndingsAndShapesAreRefused) {
  const Image image = noiseIn(3, 0, 1);
  for (const char* name : {"a", "a.jpg", "a.exr.txt", ".png", "a.hdr"}) {
    EXPECT_ERROR(ErrorId::kImageFormat, write(image, file(name)));
    EXPECT_ERROR(ErrorId::kImageFormat, checkWritable(file(name)));
  }
  EXPECT_ERROR(ErrorId::kFileUnwritable, checkWritable("/no/such/folder/a.exr"));
  checkWritable(file("a.exr"));
  EXPECT_FALSE(fs::exists(file("a.exr")));  // the check creates no file
  EXPECT_ERROR(ErrorId::kImageFormat, write(image, file("a.png"), {.pngBits = 12}));
  Image broken = image;
  broken.pixels.pop_back();
  EXPECT_ERROR(ErrorId::kImageMismatch, write(broken, file("a.png")));
  EXPECT_ERROR(ErrorId::kImageMismatch, write(Image{}, file("a.exr")));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ImageFiles, AFailureLeavesNothingBehind) {
  const Image image = noiseIn(3, 0, 1);
  EXPECT_ERROR(ErrorId::kFileUnwritable, write(image, file("missing/a.png")));
  EXPECT_ERROR(ErrorId::kFileUnwritable, write(image, file("missing/a.exr")));
  fs::create_directories(folder_ / "folder.png");
  EXPECT_ERROR(ErrorId::kFileUnwritable, write(image, file("folder.png")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(ImageFiles, AFullDiskIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this machine has no /dev/full";
  const std::string part = fmt::format("{}.{}.part", file("a.png"), getpid());
  fs::create_symlink("/dev/full", part);
  EXPECT_ERROR(ErrorId::kFileUnwritable, write(noiseIn(3, 0, 1), file("a.png")));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ImageFiles, WhatIsNoImageCannotBeRead) {
  writeFileAtomically(file("text.png"), "no image at all");
  writeFileAtomically(file("empty.exr"), "");
  mkfifo(file("pipe.png").c_str(), 0600);
  for (const char* name : {"text.png", "empty.exr", "missing.exr", "pipe.png", "."}) {
    EXPECT_ERROR(ErrorId::kImageUnreadable, read(file(name)));
  }
}

Image8 checker() {
  Image8 image{.width = 19, .height = 11, .pixels = {}};
  std::mt19937 random(5);
  for (uint32_t i = 0; i < image.width * image.height * 4; ++i) {
    image.pixels.push_back(static_cast<uint8_t>(random()));
  }
  return image;
}

TEST(Decode, ReturnsWhatWasEncoded) {
  const Image8 image = checker();
  const Image8 back = decode(encodePng(image), "checker");
  EXPECT_EQ(back.width, image.width);
  EXPECT_EQ(back.height, image.height);
  EXPECT_EQ(back.pixels, image.pixels);  // even the colour of texels with alpha 0
}

TEST_F(ImageFiles, DecodeWidensEveryChannelCount) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    for (const uint32_t bits : {8u, 16u}) {
      const Image image = noiseIn(channels, 0, 1);
      write(image, file("a.png"), {.pngBits = bits});
      const Image8 decoded = decode(bytesOf(file("a.png")), "a");
      ASSERT_EQ(decoded.pixels.size(), size_t{4} * image.width * image.height);
      for (uint32_t i = 0; i < image.width * image.height; ++i) {
        const float* from = &image.pixels[size_t{i} * channels];
        const bool grey = channels < 3;
        const float expected[] = {from[0], grey ? from[0] : from[1], grey ? from[0] : from[2],
                                  channels == 2   ? from[1]
                                  : channels == 4 ? from[3]
                                                  : 1.0f};
        for (size_t c = 0; c < 4; ++c) {
          EXPECT_NEAR(decoded.pixels[i * 4 + c], expected[c] * 255, 0.51) << channels << bits;
        }
      }
    }
  }
}

TEST(Decode, HostileBytesAreRefusedInSilence) {
  const std::vector<std::byte> good = encodePng(checker());
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const auto refused = [](std::span<const std::byte> bytes) {
    EXPECT_ERROR(ErrorId::kSceneImage, decode(bytes, "hostile"));
  };
  refused({});
  for (size_t size = 1; size + 12 < good.size(); size += 17) {
    refused(std::span(good).first(size));
  }
  std::vector<std::byte> huge = good;  // claims a width of 2^30
  huge[16] = std::byte{0x40};
  refused(huge);
  // The decoder may miss a flipped bit, but must not do harm.
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> bytes = good;
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    try {
      decode(bytes, "flipped");
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kSceneImage);
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace grisaille::image
