// SPDX-License-Identifier: MIT
#include "tests/core/gpu/checked_null.h"

namespace grisaille::tests {
namespace {

using gpu::Specialization;

class CheckedDescriptors : public CheckedNull {
 protected:
  static constexpr uint32_t kStrides[] = {12, 8};
  static constexpr gpu::VertexAttribute kAttributes[] = {
      {.location = 0, .stream = 0, .format = gpu::AttributeFormat::kFloat3},
      {.location = 1, .stream = 1, .format = gpu::AttributeFormat::kFloat2}};
  static constexpr Format kColors[] = {Format::kRgba8Unorm};

  static gpu::GraphicsPipelineDesc valid() {
    return {.label = "draw",
            .vertex = &kVertex,
            .fragment = &kFragment,
            .streamStrides = kStrides,
            .attributes = kAttributes,
            .colorFormats = kColors,
            .depthFormat = Format::kD32Float};
  }
  // Expects this error from a valid descriptor with one change.
  template <typename Change>
  void refused(ErrorId id, Change&& change) {
    gpu::GraphicsPipelineDesc desc = valid();
    change(desc);
    EXPECT_ERROR(id, device_->createGraphicsPipeline(desc));
  }
};

TEST_F(CheckedDescriptors, BufferSizes) {
  for (const uint64_t size : {uint64_t{0}, can_.maxBufferBytes + 1, ~uint64_t{0}}) {
    EXPECT_ERROR(ErrorId::kBufferSize,
                 device_->createBuffer({.size = size, .usage = BufferUsage::kVertex}));
  }
}

TEST_F(CheckedDescriptors, BufferUsages) {
  EXPECT_ERROR(ErrorId::kBufferUsage, device_->createBuffer({.size = 4}));
  EXPECT_ERROR(ErrorId::kBufferUsage,
               device_->createBuffer({.size = 4, .usage = static_cast<BufferUsage>(16)}));
}

TEST_F(CheckedDescriptors, TextureSizes) {
  const uint32_t limit = can_.maxTextureSize, layers = can_.maxTextureLayers;
  const uint32_t sizes[][3] = {{0, 4, 1},         {4, 0, 1}, {limit + 1, 4, 1},
                               {4, limit + 1, 1}, {4, 4, 0}, {4, 4, layers + 1}};
  for (const auto& [width, height, count] : sizes) {
    EXPECT_ERROR(ErrorId::kTextureSize, device_->createTexture({.format = Format::kR32Float,
                                                                .width = width,
                                                                .height = height,
                                                                .layers = count,
                                                                .usage = TextureUsage::kSampled}));
  }
}

TEST_F(CheckedDescriptors, TextureLevels) {
  const uint32_t most[][3] = {{1, 1, 1}, {2, 1, 2}, {255, 3, 8}, {5, 256, 9}};
  for (const auto& [width, height, levels] : most) {
    gpu::TextureDesc desc{.format = Format::kR32Float,
                          .width = width,
                          .height = height,
                          .mips = levels,
                          .usage = TextureUsage::kSampled};
    device_->destroy(device_->createTexture(desc));
    desc.mips = levels + 1;
    EXPECT_ERROR(ErrorId::kTextureMips, device_->createTexture(desc));
    desc.mips = 0;
    EXPECT_ERROR(ErrorId::kTextureMips, device_->createTexture(desc));
  }
}

TEST_F(CheckedDescriptors, TextureFormatsAndUsages) {
  const auto make = [&](Format format, TextureUsage usage) {
    device_->destroy(
        device_->createTexture({.format = format, .width = 4, .height = 4, .usage = usage}));
  };
  EXPECT_ERROR(ErrorId::kTextureFormat, make(Format::kNone, TextureUsage::kSampled));
  EXPECT_ERROR(ErrorId::kTextureFormat, make(static_cast<Format>(200), TextureUsage::kSampled));
  EXPECT_ERROR(ErrorId::kTextureUsage, make(Format::kR8Unorm, TextureUsage::kNone));
  EXPECT_ERROR(ErrorId::kTextureUsage, make(Format::kR8Unorm, static_cast<TextureUsage>(8)));
  for (int i = 1; i <= static_cast<int>(Format::kD32Float); ++i) {
    const Format format = static_cast<Format>(i);
    make(format, TextureUsage::kSampled | TextureUsage::kTarget);
    const TextureUsage storage = TextureUsage::kStorage | TextureUsage::kSampled;
    if (gpu::formatInfo(format).storage) {
      make(format, storage);
    } else {
      EXPECT_ERROR(ErrorId::kTextureFormat, make(format, storage));
    }
  }
}

TEST_F(CheckedDescriptors, TooManyResources) {
  std::vector<gpu::Sampler> all;
  for (int i = 0; i < 65535; ++i) all.push_back(device_->createSampler({}));
  EXPECT_ERROR(ErrorId::kTooManyResources, device_->createSampler({}));
  for (const gpu::Sampler sampler : all) device_->destroy(sampler);
}

TEST_F(CheckedDescriptors, StaleHandles) {
  const gpu::Buffer gone = buffer(16);
  device_->destroy(gone);
  EXPECT_ERROR(ErrorId::kStaleHandle, device_->destroy(gone));
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device_->read(gpu::BufferRange{.buffer = gone}));
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device_->read(gpu::Texture{}));
  EXPECT_ERROR(ErrorId::kStaleHandle, device_->destroy(gpu::GraphicsPipeline{.value = 77}));
  for (int i = 0; i < 2; ++i) {
    device_->destroy(gpu::Buffer{});
    device_->destroy(gpu::Texture{});
    device_->destroy(gpu::Sampler{});
    device_->destroy(gpu::ComputePipeline{});
    device_->destroy(gpu::GraphicsPipeline{});
  }
}

TEST_F(CheckedDescriptors, Shaders) {
  gpu::Shader truncated = kStep, empty = kStep;
  truncated.struct_size = 8;
  empty.spirv = nullptr;
  for (const gpu::Shader* shader :
       {static_cast<const gpu::Shader*>(nullptr), &kVertex, &kFragment,
        static_cast<const gpu::Shader*>(&truncated), static_cast<const gpu::Shader*>(&empty)}) {
    EXPECT_ERROR(ErrorId::kShaderMissing,
                 device_->createComputePipeline({.label = "p", .shader = shader}));
  }
  refused(ErrorId::kShaderMissing, [](auto& desc) { desc.vertex = nullptr; });
  refused(ErrorId::kShaderMissing, [](auto& desc) { desc.vertex = &kFragment; });
  refused(ErrorId::kShaderMissing, [](auto& desc) { desc.fragment = &kVertex; });
}

TEST_F(CheckedDescriptors, Constants) {
  const auto make = [&](std::vector<Specialization> constants) {
    device_->destroy(device_->createComputePipeline(
        {.label = "p", .shader = &kWithConstants, .constants = constants}));
  };
  make({});
  make({{.id = 4, .bits = 1}, {.id = 3, .bits = 77}});
  EXPECT_ERROR(ErrorId::kSpecialization, make({{.id = 5, .bits = 1}}));
  EXPECT_ERROR(ErrorId::kSpecialization, make({{.id = 3, .bits = 1}, {.id = 3, .bits = 1}}));
  EXPECT_ERROR(ErrorId::kSpecialization, make({{.id = 4, .bits = 2}}));
  const Specialization unknown[] = {{.id = 3, .bits = 1}};
  refused(ErrorId::kSpecialization, [&](auto& desc) { desc.constants = unknown; });
}

TEST_F(CheckedDescriptors, VertexLayouts) {
  device_->destroy(device_->createGraphicsPipeline(valid()));
  const auto attributes = [&](std::vector<gpu::VertexAttribute> rows) {
    refused(ErrorId::kVertexLayout, [&](auto& desc) { desc.attributes = rows; });
  };
  const gpu::VertexAttribute position = kAttributes[0], uv = kAttributes[1];
  attributes({});
  attributes({position});
  attributes({position, uv, uv});
  const auto changed = [](gpu::VertexAttribute row, auto&& change) {
    change(row);
    return row;
  };
  attributes({position, changed(uv, [](auto& row) { row.stream = 2; })});
  attributes({position, changed(uv, [](auto& row) { row.offset = 4; })});
  attributes({position, changed(uv, [](auto& row) { row.offset = ~0u - 3; })});
  attributes(
      {position, changed(uv, [](auto& row) { row.format = gpu::AttributeFormat::kFloat1; })});
  attributes({position,
              changed(uv, [](auto& row) { row.format = static_cast<gpu::AttributeFormat>(9); })});
  for (const std::vector<uint32_t>& strides :
       {std::vector<uint32_t>{12, 0}, {12, 9}, {12, 8, 4, 4, 4}, {8, 8}}) {
    refused(ErrorId::kVertexLayout, [&](auto& desc) { desc.streamStrides = strides; });
  }
}

TEST_F(CheckedDescriptors, PipelineTargets) {
  const auto colors = [&](std::vector<Format> formats) {
    refused(ErrorId::kPipelineTargets, [&](auto& desc) { desc.colorFormats = formats; });
  };
  colors({});
  colors({Format::kRgba8Unorm, Format::kRgba8Unorm});
  colors({Format::kD32Float});
  colors({Format::kNone});
  colors({Format::kR32Uint});
  refused(ErrorId::kPipelineTargets, [](auto& desc) { desc.depthFormat = Format::kR32Float; });
  refused(ErrorId::kPipelineTargets, [](auto& desc) { desc.fragment = nullptr; });
  gpu::GraphicsPipelineDesc depthOnly = valid();
  depthOnly.fragment = nullptr;
  depthOnly.colorFormats = {};
  device_->destroy(device_->createGraphicsPipeline(depthOnly));
  depthOnly.depthFormat = Format::kNone;
  EXPECT_ERROR(ErrorId::kPipelineTargets, device_->createGraphicsPipeline(depthOnly));
}

TEST_F(CheckedDescriptors, BlendsOfFormatsThatBlend) {
  using gpu::Blend;
  for (int i = 1; i < static_cast<int>(Format::kD32Float); ++i) {
    const Format formats[] = {static_cast<Format>(i)};
    if (formats[0] == Format::kR32Uint) continue;  // the shader's output is not an integer
    gpu::GraphicsPipelineDesc desc = valid();
    desc.colorFormats = formats;
    desc.blend = Blend::kOver;
    if (gpu::formatInfo(formats[0]).blends) {
      device_->destroy(device_->createGraphicsPipeline(desc));
    } else {
      EXPECT_ERROR(ErrorId::kPipelineTargets, device_->createGraphicsPipeline(desc));
    }
    desc.blend = Blend::kNone;
    device_->destroy(device_->createGraphicsPipeline(desc));
  }
  EXPECT_TRUE(gpu::formatInfo(Format::kRgba8Unorm).blends);
  EXPECT_FALSE(gpu::formatInfo(Format::kR32Uint).blends);
  refused(ErrorId::kPipelineTargets, [](auto& desc) { desc.blend = static_cast<Blend>(2); });
}

// A vec4 attribute may be fed from 4 bytes.
TEST_F(CheckedDescriptors, AttributesOfBytes) {
  using gpu::AttributeFormat;
  EXPECT_EQ(gpu::attributeBytes(AttributeFormat::kFloat1), 4u);
  EXPECT_EQ(gpu::attributeBytes(AttributeFormat::kFloat4), 16u);
  EXPECT_EQ(gpu::attributeBytes(AttributeFormat::kUnorm8x4), 4u);
  constexpr grisaille_shader_location kColor[] = {{0, GRISAILLE_SCALAR_FLOAT, 4, "color"}};
  gpu::Shader vertex = kVertex;
  vertex.inputs = kColor;
  vertex.input_count = 1;
  const uint32_t strides[] = {4};
  gpu::VertexAttribute attributes[] = {{.location = 0, .format = AttributeFormat::kUnorm8x4}};
  gpu::GraphicsPipelineDesc desc = valid();
  desc.vertex = &vertex;
  desc.streamStrides = strides;
  desc.attributes = attributes;
  device_->destroy(device_->createGraphicsPipeline(desc));
  attributes[0].format = AttributeFormat::kFloat4;  // 16 bytes
  EXPECT_ERROR(ErrorId::kVertexLayout, device_->createGraphicsPipeline(desc));
  attributes[0].format = AttributeFormat::kFloat1;  // one component
  EXPECT_ERROR(ErrorId::kVertexLayout, device_->createGraphicsPipeline(desc));
}

TEST_F(CheckedDescriptors, LeaksAreReported) {
  device_->createBuffer({.label = "b", .size = 4, .usage = BufferUsage::kVertex});
  texture(TextureUsage::kSampled);
  device_->createSampler({.label = "s"});
  compute(kStep);
  device_->createGraphicsPipeline(valid());
  device_->destroy(buffer(4));
  gpu::Commands& commands = device_->begin();
  commands.transient({.label = "t",
                      .format = Format::kR32Float,
                      .width = 4,
                      .height = 4,
                      .usage = TextureUsage::kSampled});
  device_->submit();
  device_.reset();
  EXPECT_EQ(messages_.size(), 5u);
  for (const std::string& message : messages_) {
    EXPECT_EQ(message.rfind("error E1218: ", 0), 0u) << message;
  }
}

}  // namespace
}  // namespace grisaille::tests
