// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "shaders/sample_array_comp.h"
#include "shaders/sample_comp.h"
#include "tests/support/devices.h"

namespace grisaille::tests {
namespace {

using gpu::Address;
using gpu::Filter;
using gpu::Format;
using gpu::TextureUsage;

constexpr uint32_t kWidth = 8, kHeight = 4;
using Vec4 = std::array<float, 4>;

float texel(int x, int y) {
  return static_cast<float>(y * 100 + x);
}

// Texel index that the address mode gives for a coordinate outside the texture.
int wrapped(int i, int size, Address address) {
  switch (address) {
    case Address::kClamp:
      return std::clamp(i, 0, size - 1);
    case Address::kRepeat:
      return (i % size + size) % size;
    case Address::kMirror: {
      const int in = (i % (2 * size) + 2 * size) % (2 * size);
      return in < size ? in : 2 * size - 1 - in;
    }
  }
  return 0;
}

class Sampling : public BackendTest {
 protected:
  gpu::Texture texture() {
    std::vector<float> values;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) {
      values.push_back(texel(static_cast<int>(i % kWidth), static_cast<int>(i / kWidth)));
    }
    const gpu::Texture made = makeTexture({.format = Format::kR32Float,
                                           .width = kWidth,
                                           .height = kHeight,
                                           .usage = TextureUsage::kSampled});
    fill(made, values);
    return made;
  }

  std::vector<Vec4> sampled(gpu::TextureView view, const gpu::SamplerDesc& sampler,
                            const std::vector<Vec4>& places, bool arrayed = false) {
    const gpu::Buffer in = bufferOf(places, gpu::BufferUsage::kStorage);
    const gpu::Buffer out = makeBuffer(places.size() * 16, gpu::BufferUsage::kStorage);
    const gpu::Binding bindings[] = {gpu::textureBinding(0, view, makeSampler(sampler)),
                                     gpu::storageBinding(0, {.buffer = in}),
                                     gpu::storageBinding(1, {.buffer = out})};
    const gpu::ComputePipeline pipeline =
        makeCompute(arrayed ? grisaille_shader_sample_array_comp : grisaille_shader_sample_comp);
    const uint32_t groups = (static_cast<uint32_t>(places.size()) + 63) / 64;
    compute({.pipeline = pipeline, .bindings = bindings, .groups = {groups, 1, 1}});
    return readBuffer<Vec4>({.buffer = out});
  }
};
GRISAILLE_ON_EVERY_DEVICE(Sampling);

TEST_P(Sampling, NearestAndLinearWithEveryAddressMode) {
  const gpu::Texture source = texture();
  // Texel coordinates from two sizes to the left to two sizes to the right, off the exact borders.
  std::vector<Vec4> places;
  for (int i = -40; i <= 60; ++i) {
    const float x = static_cast<float>(i) * 0.37f + 0.055f,
                y = static_cast<float>(i) * 0.21f + 0.035f;
    places.push_back({x / kWidth, y / kHeight, 0, 0});
  }
  for (const Address u : {Address::kClamp, Address::kRepeat, Address::kMirror}) {
    for (const Address v : {Address::kClamp, Address::kRepeat, Address::kMirror}) {
      const auto at = [&](int x, int y) {
        return texel(wrapped(x, kWidth, u), wrapped(y, kHeight, v));
      };
      gpu::SamplerDesc desc{.label = "address", .addressU = u, .addressV = v};
      const std::vector<Vec4> nearest = sampled({.texture = source}, desc, places);
      desc.filter = Filter::kLinear;
      const std::vector<Vec4> linear = sampled({.texture = source}, desc, places);
      for (size_t i = 0; i < places.size(); ++i) {
        const float x = places[i][0] * kWidth, y = places[i][1] * kHeight;
        const int nearX = static_cast<int>(std::floor(x)), nearY = static_cast<int>(std::floor(y));
        EXPECT_EQ(nearest[i][0], at(nearX, nearY)) << x << ", " << y;
        const int x0 = static_cast<int>(std::floor(x - 0.5f));
        const int y0 = static_cast<int>(std::floor(y - 0.5f));
        const float fx = x - 0.5f - static_cast<float>(x0), fy = y - 0.5f - static_cast<float>(y0);
        const float expected = std::lerp(std::lerp(at(x0, y0), at(x0 + 1, y0), fx),
                                         std::lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), fx), fy);
        // Filter weights have at least 8 bits; neighbouring texels differ by at most 300.
        EXPECT_NEAR(linear[i][0], expected, 300.0 / 256 * 2) << x << ", " << y;
      }
    }
  }
}

TEST_P(Sampling, ChoosesMipLevels) {
  const gpu::Texture source = makeTexture({.format = Format::kR32Float,
                                           .width = 8,
                                           .height = 8,
                                           .mips = 4,
                                           .usage = TextureUsage::kSampled});
  for (uint32_t mip = 0; mip < 4; ++mip) {
    const size_t size = 8u >> mip;
    fill(source, std::vector<float>(size * size, static_cast<float>(mip) * 10), mip);
  }
  std::vector<Vec4> places;
  for (const float level : {0.0f, 0.25f, 0.75f, 1.0f, 1.6f, 2.5f, 3.0f, 9.0f}) {
    places.push_back({0.5f, 0.5f, level, 0});
  }
  const auto linear =
      sampled({.texture = source}, {.label = "mips", .mipFilter = Filter::kLinear}, places);
  const auto nearest = sampled({.texture = source}, {.label = "mips"}, places);
  for (size_t i = 0; i < places.size(); ++i) {
    const float level = std::min(places[i][2], 3.0f);
    EXPECT_NEAR(linear[i][0], level * 10, 10.0 / 128);
    if (level == 2.5f) continue;  // halfway: either level is valid
    EXPECT_EQ(nearest[i][0], std::round(level) * 10) << level;
  }
}

TEST_P(Sampling, AViewShowsItsLevelsOnly) {
  const gpu::Texture source = makeTexture({.format = Format::kR32Float,
                                           .width = 4,
                                           .height = 4,
                                           .mips = 3,
                                           .usage = TextureUsage::kSampled});
  for (uint32_t mip = 0; mip < 3; ++mip) {
    fill(source, std::vector<float>((4u >> mip) * (4u >> mip), static_cast<float>(mip)), mip);
  }
  const std::vector<Vec4> places = {{0.5f, 0.5f, 0, 0}, {0.5f, 0.5f, 1, 0}, {0.5f, 0.5f, 2, 0}};
  const auto values = [&](uint32_t mip, uint32_t count) {
    const auto samples =
        sampled({.texture = source, .mip = mip, .mipCount = count}, {.label = "view"}, places);
    return std::array{samples[0][0], samples[1][0], samples[2][0]};
  };
  EXPECT_EQ(values(0, 0), (std::array{0.0f, 1.0f, 2.0f}));
  EXPECT_EQ(values(1, 1), (std::array{1.0f, 1.0f, 1.0f}));
  EXPECT_EQ(values(1, 0), (std::array{1.0f, 2.0f, 2.0f}));
  EXPECT_EQ(values(0, 2), (std::array{0.0f, 1.0f, 1.0f}));
  EXPECT_EQ(values(2, 0), (std::array{2.0f, 2.0f, 2.0f}));
}

TEST_P(Sampling, ArraysGiveTheirLayers) {
  const gpu::Texture source = makeTexture({.format = Format::kR32Float,
                                           .width = 3,
                                           .height = 2,
                                           .layers = 5,
                                           .usage = TextureUsage::kSampled});
  for (uint32_t layer = 0; layer < 5; ++layer) {
    fill(source, std::vector<float>(6, static_cast<float>(layer) + 0.5f), 0, layer);
  }
  std::vector<Vec4> places;
  for (int layer = 0; layer < 5; ++layer)
    places.push_back({0.5f, 0.5f, 0, static_cast<float>(layer)});
  const auto all = sampled({.texture = source}, {.label = "array"}, places, true);
  const auto part = sampled({.texture = source, .layer = 2, .layerCount = 2}, {.label = "array"},
                            {places[0], places[1]}, true);
  for (size_t layer = 0; layer < 5; ++layer) {
    EXPECT_EQ(all[layer][0], static_cast<float>(layer) + 0.5f);
    // A view of one layer is 2D.
    const auto one =
        sampled({.texture = source, .layer = static_cast<uint32_t>(layer), .layerCount = 1},
                {.label = "layer"}, {places[0]});
    EXPECT_EQ(one[0][0], static_cast<float>(layer) + 0.5f);
  }
  EXPECT_EQ(part[0][0], 2.5f);
  EXPECT_EQ(part[1][0], 3.5f);
}

TEST_P(Sampling, AnArrayMayHaveOneLayer) {
  const auto samples = sampled({.texture = texture()}, {.label = "array"},
                               {{2.5f / kWidth, 1.5f / kHeight, 0, 0}}, true);
  EXPECT_EQ(samples[0][0], texel(2, 1));
}

TEST_P(Sampling, SrgbBecomesLinear) {
  const gpu::Texture source = makeTexture(
      {.format = Format::kRgba8Srgb, .width = 256, .height = 1, .usage = TextureUsage::kSampled});
  std::vector<uint8_t> ramp;
  std::vector<Vec4> places;
  for (int i = 0; i < 256; ++i) {
    ramp.insert(ramp.end(), 4, static_cast<uint8_t>(i));
    places.push_back({(static_cast<float>(i) + 0.5f) / 256, 0.5f, 0, 0});
  }
  fill(source, ramp);
  const auto samples = sampled({.texture = source}, {.label = "srgb"}, places);
  for (size_t i = 0; i < 256; ++i) {
    const float code = static_cast<float>(i) / 255;
    const float linear =
        code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
    const float sampled = std::max(samples[i][0], 0.0f);
    const float back =
        sampled <= 0.0031308f ? 12.92f * sampled : 1.055f * std::pow(sampled, 1 / 2.4f) - 0.055f;
    // GPUs may be off by half a step between codes (Direct3D's rule; NVIDIA's are by a third).
    EXPECT_NEAR(back, code, 0.5f / 255) << linear;
    if (device().info().software) {
      EXPECT_NEAR(samples[i][0], linear, 2e-3);
    }
    EXPECT_NEAR(samples[i][3], code, 1e-5);  // alpha is linear
  }
}

TEST_P(Sampling, MissingChannelsAreZeroAndOne) {
  const gpu::Texture source = texture();
  const auto samples = sampled({.texture = source}, {.label = "r"}, {{0.99f, 0.01f, 0, 0}});
  EXPECT_EQ(samples[0], (Vec4{7, 0, 0, 1}));
}

// Drivers place the taps of an anisotropic filter differently; on a constant texture, every choice
// gives the constant.
TEST_P(Sampling, AnisotropyIsClampedToTheDevice) {
  const gpu::Texture source = makeTexture(
      {.format = Format::kR32Float, .width = 8, .height = 8, .usage = TextureUsage::kSampled});
  fill(source, std::vector<float>(64, 3.5f));
  for (const float most : {2.0f, 16.0f, 1024.0f}) {
    const gpu::SamplerDesc sampler{.label = "anisotropic",
                                   .filter = Filter::kLinear,
                                   .mipFilter = Filter::kLinear,
                                   .maxAnisotropy = most};
    EXPECT_NEAR(sampled({.texture = source}, sampler, {{0.4f, 0.3f, 0, 0}})[0][0], 3.5f, 1e-4);
  }
}

}  // namespace
}  // namespace grisaille::tests
