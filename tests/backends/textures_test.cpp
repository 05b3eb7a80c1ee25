// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "shaders/fetch_comp.h"
#include "shaders/fragcoord_frag.h"
#include "shaders/image_float_comp.h"
#include "shaders/position_vert.h"
#include "tests/support/devices.h"

namespace grisaille::tests {
namespace {

using gpu::Format;
using gpu::TextureUsage;

class Textures : public BackendTest {
 protected:
  std::mt19937 random_{20240611};

  // Bytes that every copy must preserve: any for normalised formats and integers, finite floats (0
  // to 1, as depth requires).
  std::vector<std::byte> contents(Format format, size_t texels) {
    const gpu::FormatInfo& info = gpu::formatInfo(format);
    std::vector<std::byte> bytes(texels * info.texelBytes);
    const size_t channelBytes = info.texelBytes / info.channels;
    const bool integers = channelBytes == 1 || format == Format::kR32Uint;
    for (size_t at = 0; at < bytes.size(); at += channelBytes) {
      uint32_t bits = static_cast<uint32_t>(random_());
      if (!integers && channelBytes == 2) bits = bits % 0x3c01u;  // half floats of 0 ... 1
      if (!integers && channelBytes == 4) {
        const float value = std::ldexp(static_cast<float>(bits >> 8), -24);
        std::memcpy(&bits, &value, sizeof bits);
      }
      std::memcpy(&bytes[at], &bits, channelBytes);
    }
    return bytes;
  }
};
GRISAILLE_ON_EVERY_DEVICE(Textures);

constexpr Format kAllFormats[] = {Format::kR8Unorm,   Format::kRgba8Unorm,  Format::kRgba8Srgb,
                                  Format::kR16Float,  Format::kRgba16Float, Format::kR32Float,
                                  Format::kRg32Float, Format::kRgba32Float, Format::kR32Uint,
                                  Format::kD32Float};

TEST_P(Textures, OfEveryFormatHoldWhatIsUploaded) {
  constexpr uint32_t kSizes[][2] = {{1, 1}, {3, 5}, {257, 129}};
  for (const Format format : kAllFormats) {
    for (const auto& size : kSizes) {
      const uint32_t width = size[0], height = size[1];
      const uint32_t mips =
          static_cast<uint32_t>(std::floor(std::log2(std::max(width, height)))) + 1;
      const uint32_t layers = 3;
      const gpu::Texture texture = makeTexture({.format = format,
                                                .width = width,
                                                .height = height,
                                                .mips = mips,
                                                .layers = layers,
                                                .usage = TextureUsage::kSampled});
      std::vector<std::vector<std::byte>> uploaded;
      inFrame([&](gpu::Commands& commands) {
        for (uint32_t layer = 0; layer < layers; ++layer) {
          for (uint32_t mip = 0; mip < mips; ++mip) {
            const size_t texels = size_t{std::max(1u, width >> mip)} * std::max(1u, height >> mip);
            uploaded.push_back(contents(format, texels));
            commands.upload(texture, mip, layer, uploaded.back());
          }
        }
      });
      for (uint32_t i = 0; i < mips * layers; ++i) {
        EXPECT_EQ(device().read(texture, i % mips, i / mips), uploaded[i])
            << gpu::formatInfo(format).name << " " << width << "x" << height << " mip " << i % mips
            << " layer " << i / mips;
      }
    }
  }
}

TEST_P(Textures, LaterUploadsReplaceEarlierOnes) {
  const gpu::Texture texture = makeTexture(
      {.format = Format::kRgba8Unorm, .width = 33, .height = 7, .usage = TextureUsage::kSampled});
  std::vector<std::byte> last;
  for (int frame = 0; frame < 5; ++frame) {
    inFrame([&](gpu::Commands& commands) {
      for (int i = 0; i < 3; ++i) {
        last = contents(Format::kRgba8Unorm, 33 * 7);
        commands.upload(texture, 0, 0, last);
      }
    });
  }
  EXPECT_EQ(device().read(texture), last);
}

// Row 0 is the top row in uploads, image stores, drawing, fetches and readback.
class RowOrder : public BackendTest {
 protected:
  static constexpr uint32_t kWidth = 13, kHeight = 7;
  static float valueAt(uint32_t x, uint32_t y) {
    return static_cast<float>(y) + static_cast<float>(x) / 1024.0f;
  }
  static std::vector<float> expected() {
    std::vector<float> values;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i)
      values.push_back(valueAt(i % kWidth, i / kWidth));
    return values;
  }
  std::vector<float> fetched(gpu::Texture texture) {
    const gpu::Buffer out = makeBuffer(kWidth * kHeight * 4, gpu::BufferUsage::kStorage);
    const gpu::Sampler sampler = makeSampler({.label = "nearest"});
    const gpu::Binding bindings[] = {gpu::textureBinding(0, {.texture = texture}, sampler),
                                     gpu::storageBinding(0, {.buffer = out})};
    compute({.pipeline = makeCompute(grisaille_shader_fetch_comp),
             .bindings = bindings,
             .groups = {2, 1, 1}});
    return readBuffer<float>({.buffer = out});
  }
};
GRISAILLE_ON_EVERY_DEVICE(RowOrder);

TEST_P(RowOrder, OfUploads) {
  const gpu::Texture texture = makeTexture({.format = Format::kR32Float,
                                            .width = kWidth,
                                            .height = kHeight,
                                            .usage = TextureUsage::kSampled});
  fill(texture, expected());
  EXPECT_EQ(fetched(texture), expected());
}

TEST_P(RowOrder, OfImageStores) {
  const gpu::Texture texture =
      makeTexture({.format = Format::kR32Float,
                   .width = kWidth,
                   .height = kHeight,
                   .usage = TextureUsage::kSampled | TextureUsage::kStorage});
  const gpu::Binding bindings[] = {gpu::imageBinding(0, texture)};
  compute({.pipeline = makeCompute(grisaille_shader_image_float_comp),
           .bindings = bindings,
           .groups = {2, 1, 1}});
  EXPECT_EQ(readTexture<float>(texture), expected());
  EXPECT_EQ(fetched(texture), expected());
}

TEST_P(RowOrder, OfDrawing) {
  const gpu::Texture texture =
      makeTexture({.format = Format::kRgba32Float,
                   .width = kWidth,
                   .height = kHeight,
                   .usage = TextureUsage::kSampled | TextureUsage::kTarget});
  const std::vector<float> corners = {-1, -3, 0.5f, 3, 1, 0.5f, -1, 1, 0.5f};
  const gpu::Buffer vertices = bufferOf(corners, gpu::BufferUsage::kVertex);
  const uint32_t strides[] = {12};
  const gpu::VertexAttribute attributes[] = {{.location = 0}};
  const Format formats[] = {Format::kRgba32Float};
  const gpu::GraphicsPipeline pipeline = makeGraphics({.vertex = &grisaille_shader_position_vert,
                                                       .fragment = &grisaille_shader_fragcoord_frag,
                                                       .streamStrides = strides,
                                                       .attributes = attributes,
                                                       .colorFormats = formats});
  const gpu::BufferRange streams[] = {{.buffer = vertices}};
  const gpu::Draw draws[] = {{.pipeline = pipeline, .vertexStreams = streams, .count = 3}};
  const gpu::ColorTarget colors[] = {{.view = {.texture = texture}}};
  render({.colors = colors, .draws = draws});
  const std::vector<float> values = readTexture<float>(texture);
  const std::vector<float> xs = fetched(texture);
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const size_t at = y * kWidth + x;
      EXPECT_EQ(values[at * 4], static_cast<float>(x) + 0.5f);
      EXPECT_EQ(values[at * 4 + 1], static_cast<float>(y) + 0.5f);
      EXPECT_EQ(values[at * 4 + 2], 0.5f);
      EXPECT_EQ(xs[at], static_cast<float>(x) + 0.5f);
    }
  }
}

}  // namespace
}  // namespace grisaille::tests
