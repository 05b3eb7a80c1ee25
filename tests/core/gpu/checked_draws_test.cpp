// SPDX-License-Identifier: MIT
#include <functional>

#include "tests/core/gpu/checked_null.h"

namespace grisaille::tests {
namespace {

using gpu::Load;

// Each test starts from a valid render call and introduces one fault.
class CheckedDraws : public CheckedNull {
 protected:
  struct Call {
    std::vector<gpu::Binding> bindings;
    std::vector<gpu::BufferRange> streams;
    gpu::Draw draw;
    std::vector<gpu::ColorTarget> colors;
    gpu::DepthTarget depth;
  };

  CheckedDraws() {
    static constexpr uint32_t kStrides[] = {12, 8};
    static constexpr gpu::VertexAttribute kAttributes[] = {
        {.location = 0, .stream = 0, .format = gpu::AttributeFormat::kFloat3},
        {.location = 1, .stream = 1, .format = gpu::AttributeFormat::kFloat2}};
    static constexpr Format kColors[] = {Format::kRgba8Unorm};
    pipeline_ = device_->createGraphicsPipeline({.label = "draw",
                                                 .vertex = &kVertex,
                                                 .fragment = &kFragment,
                                                 .streamStrides = kStrides,
                                                 .attributes = kAttributes,
                                                 .colorFormats = kColors,
                                                 .depthFormat = Format::kD32Float});
  }

  Call valid() {
    Call call;
    call.bindings = {gpu::textureBinding(2, {texels_}, sampler_)};
    call.streams = {{positions_}, {uvs_}};
    call.draw = {.pipeline = pipeline_, .count = 10};
    call.colors = {{.view = {.texture = color_}}};
    call.depth = {.view = {.texture = depth_}};
    return call;
  }
  void issue(gpu::Commands& commands, Call call) {
    call.draw.bindings = call.bindings;
    call.draw.vertexStreams = call.streams;
    commands.render({.colors = call.colors, .depth = call.depth, .draws = {&call.draw, 1}});
  }
  void accepted(const std::function<void(Call&)>& change) {
    Call call = valid();
    change(call);
    gpu::Commands& commands = inPass();
    EXPECT_NO_THROW(issue(commands, call));
    finish(commands);
  }
  void refused(ErrorId id, const std::function<void(Call&)>& change) {
    Call call = valid();
    change(call);
    gpu::Commands& commands = inPass();
    EXPECT_ERROR(id, issue(commands, call));
    finish(commands);
  }
  gpu::Texture target(Format format, uint32_t size = 16, uint32_t mips = 1, uint32_t layers = 1) {
    return texture(
        TextureUsage::kTarget | TextureUsage::kSampled,
        {.format = format, .width = size, .height = size, .mips = mips, .layers = layers}, false);
  }

  const gpu::Buffer positions_ = buffer(120, BufferUsage::kVertex);
  const gpu::Buffer uvs_ = buffer(80, BufferUsage::kVertex);
  const gpu::Buffer indices_ = buffer(40, BufferUsage::kIndex);
  const gpu::Texture texels_ = texture(TextureUsage::kSampled);
  const gpu::Texture color_ = target(Format::kRgba8Unorm), depth_ = target(Format::kD32Float);
  const gpu::Sampler sampler_ = device_->createSampler({});
  gpu::GraphicsPipeline pipeline_;
};

TEST_F(CheckedDraws, ValidOnesPass) {
  accepted([](Call&) {});
  accepted([&](Call& call) { call.draw.indices = {indices_}; });
  accepted([&](Call& call) {
    call.draw.first = 9;
    call.draw.count = 1;
  });
}

TEST_F(CheckedDraws, TargetsOfOneSize) {
  const ErrorId id = ErrorId::kTargetMismatch;
  refused(id, [](Call& call) {
    call.colors.clear();
    call.depth = {};
  });
  refused(id, [&](Call& call) { call.depth.view.texture = target(Format::kD32Float, 8); });
  refused(id, [](Call& call) { call.colors[0].view.texture = {}; });
  refused(id, [&](Call& call) {
    call.colors.assign(5, {});
    for (gpu::ColorTarget& color : call.colors) color.view.texture = target(Format::kRgba8Unorm);
  });
  // A mip of the right size is accepted.
  accepted([&](Call& call) {
    call.depth.view = {.texture = target(Format::kD32Float, 32, 2, 2), .mip = 1, .layer = 1};
  });
}

TEST_F(CheckedDraws, TargetsInRange) {
  refused(ErrorId::kBindingRange, [](Call& call) { call.colors[0].view.mip = 1; });
  refused(ErrorId::kBindingRange, [](Call& call) { call.depth.view.layer = 1; });
  refused(ErrorId::kTextureUsage, [&](Call& call) {
    call.colors[0].view.texture = texture(TextureUsage::kSampled, {.format = Format::kRgba8Unorm});
  });
}

TEST_F(CheckedDraws, TargetsOfThePipelinesFormats) {
  const ErrorId id = ErrorId::kPipelineTargets;
  refused(id, [&](Call& call) { call.colors[0].view.texture = target(Format::kRgba8Srgb); });
  refused(id, [&](Call& call) { call.colors[0].view.texture = depth_; });
  refused(id, [&](Call& call) { call.depth.view.texture = target(Format::kR32Float); });
  refused(id, [](Call& call) { call.depth = {}; });
  refused(id, [](Call& call) { call.colors.clear(); });
  refused(id, [&](Call& call) {
    call.colors.push_back({.view = {.texture = target(Format::kRgba8Unorm)}});
  });
}

TEST_F(CheckedDraws, VerticesAndIndicesThatAreThere) {
  const ErrorId id = ErrorId::kDrawRange;
  refused(id, [](Call& call) { call.draw.count = 0; });
  refused(id, [](Call& call) { call.draw.count = 11; });
  refused(id, [](Call& call) { call.draw.first = 1; });
  refused(id, [](Call& call) { call.draw.count = call.draw.first = ~0u; });
  refused(id, [](Call& call) { call.streams.pop_back(); });
  refused(id, [](Call& call) { call.streams[1].offset = 8; });
  refused(id, [](Call& call) { call.streams[1].offset = 2; });
  refused(id, [](Call& call) { call.streams[0].size = 116; });
  refused(id, [](Call& call) { call.streams[0].size = 124; });
  refused(id, [](Call& call) { call.streams[0].offset = 120; });
  refused(id, [&](Call& call) {
    call.draw.indices = {indices_};
    call.draw.count = 11;
  });
  refused(id, [&](Call& call) { call.draw.indices = {indices_, 4}; });
  refused(id, [&](Call& call) { call.draw.indices = {indices_, 0, 36}; });
  refused(id, [&](Call& call) {
    call.draw.indices = {indices_};
    call.streams[0].offset = 112;  // room for less than one vertex
  });
  // From the offset on, one vertex fewer fits.
  accepted([](Call& call) {
    call.streams[1].offset = 8;
    call.draw.count = 9;
  });
}

TEST_F(CheckedDraws, ScissorsInsideTheTargets) {
  const std::vector<gpu::Scissor> inside = {
      {}, {0, 0, 16, 16}, {15, 15, 1, 1}, {3, 5, 13, 11}, {99, 99, 0, 0}};
  for (const gpu::Scissor& scissor : inside) {
    accepted([&](Call& call) { call.draw.scissor = scissor; });
  }
  const std::vector<gpu::Scissor> outside = {{0, 0, 17, 16}, {0, 0, 16, 17}, {16, 0, 1, 1},
                                             {0, 16, 1, 1},  {3, 5, 14, 11}, {3, 5, 13, 12},
                                             {0, 0, 16, 0},  {1, 1, ~0u, 1}, {~0u, 0, 16, 1}};
  for (const gpu::Scissor& scissor : outside) {
    refused(ErrorId::kScissor, [&](Call& call) { call.draw.scissor = scissor; });
  }
}

TEST_F(CheckedDraws, BuffersOfTheRightUsage) {
  refused(ErrorId::kBufferUsage, [&](Call& call) { call.streams[0] = {indices_}; });
  refused(ErrorId::kBufferUsage, [&](Call& call) { call.draw.indices = {uvs_}; });
  refused(ErrorId::kStaleHandle, [](Call& call) { call.streams[0] = {}; });
}

TEST_F(CheckedDraws, BindingsOfBothStages) {
  refused(ErrorId::kBindingMissing, [](Call& call) { call.bindings.clear(); });
  refused(ErrorId::kBindingUnknown, [](Call& call) { call.bindings[0].slot = 1; });
  refused(ErrorId::kStaleHandle, [](Call& call) { call.draw.pipeline = {}; });
}

TEST_F(CheckedDraws, Hazards) {
  const gpu::Texture both = target(Format::kRgba8Unorm, 16, 2);
  accepted([&](Call& call) { call.colors[0].view.texture = both; });
  const auto sampling = [&](uint32_t mip) {
    return [&, mip](Call& call) {
      call.colors[0].view = {.texture = both};
      call.bindings[0].view = {.texture = both, .mip = mip, .mipCount = 1};
    };
  };
  refused(ErrorId::kHazard, sampling(0));
  refused(ErrorId::kUninitialised, sampling(1));
  accepted([&](Call& call) {
    call.colors[0].view = {.texture = both, .mip = 1};
    call.depth.view.texture = target(Format::kD32Float, 8);
  });
  accepted(sampling(1));
  refused(ErrorId::kHazard, [&](Call& call) { call.bindings[0].view.texture = depth_; });
}

TEST_F(CheckedDraws, ContentsThatWereNeverWritten) {
  const ErrorId id = ErrorId::kUninitialised;
  refused(id, [](Call& call) { call.colors[0].load = Load::kLoad; });
  refused(id, [](Call& call) { call.depth.load = Load::kLoad; });
  refused(id, [&](Call& call) { call.streams[0] = {buffer(120, BufferUsage::kVertex, false)}; });
  refused(id, [&](Call& call) { call.draw.indices = {buffer(40, BufferUsage::kIndex, false)}; });
  accepted([](Call& call) { call.colors[0].load = Load::kDiscard; });
  accepted([](Call& call) { call.colors[0].load = call.depth.load = Load::kLoad; });
}

}  // namespace
}  // namespace grisaille::tests
