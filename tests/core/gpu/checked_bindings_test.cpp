// SPDX-License-Identifier: MIT
#include "tests/core/gpu/checked_null.h"

namespace grisaille::tests {
namespace {

class CheckedBindings : public CheckedNull {
 protected:
  const gpu::ComputePipeline copy_ = compute(kCopy), step_ = compute(kStep),
                             filter_ = compute(kFilter), imageStep_ = compute(kImageStep),
                             array_ = compute(kArray);
  const gpu::Buffer uniforms_ = buffer(512, BufferUsage::kUniform);
  const gpu::Buffer from_ = buffer(1024), to_ = buffer(1024);
  const gpu::Sampler sampler_ = device_->createSampler({.label = "nearest"});
  const gpu::Texture texels_ = texture(TextureUsage::kSampled);
  const gpu::Texture result_ = texture(TextureUsage::kStorage | TextureUsage::kSampled, {}, false);

  // Expects that these bindings are refused; the frame continues.
  void refused(ErrorId id, gpu::ComputePipeline pipeline, std::vector<gpu::Binding> bindings) {
    gpu::Commands& commands = inPass();
    EXPECT_ERROR(id, commands.dispatch({.pipeline = pipeline, .bindings = bindings}));
    finish(commands);
  }
  void accepted(gpu::ComputePipeline pipeline, std::vector<gpu::Binding> bindings) {
    gpu::Commands& commands = inPass();
    EXPECT_NO_THROW(commands.dispatch({.pipeline = pipeline, .bindings = bindings}));
    finish(commands);
  }
  std::vector<gpu::Binding> copying(gpu::BufferRange block, gpu::BufferRange from,
                                    gpu::BufferRange to) {
    return {gpu::uniformBinding(0, block), gpu::storageBinding(0, from),
            gpu::storageBinding(1, to)};
  }
  std::vector<gpu::Binding> filtering(gpu::TextureView from, gpu::Binding to) {
    return {gpu::textureBinding(0, from, sampler_), to};
  }
};

TEST_F(CheckedBindings, AllMustBeThere) {
  accepted(copy_, copying({uniforms_}, {from_}, {to_}));
  refused(ErrorId::kBindingMissing, copy_, {});
  refused(ErrorId::kBindingMissing, copy_,
          {gpu::uniformBinding(0, {uniforms_}), gpu::storageBinding(1, {to_})});
  refused(ErrorId::kBindingMissing, copy_, copying({uniforms_}, {}, {to_}));
  refused(ErrorId::kBindingMissing, filter_, filtering({}, gpu::imageBinding(0, result_)));
  refused(ErrorId::kBindingMissing, filter_,
          {gpu::textureBinding(0, {texels_}, {}), gpu::imageBinding(0, result_)});
}

TEST_F(CheckedBindings, NoneMoreAndNoneTwice) {
  std::vector<gpu::Binding> bindings = copying({uniforms_}, {from_}, {to_});
  bindings.push_back(gpu::storageBinding(2, {to_}));
  refused(ErrorId::kBindingUnknown, copy_, bindings);
  bindings.back() = gpu::uniformBinding(0, {uniforms_});
  refused(ErrorId::kBindingUnknown, copy_, bindings);
  bindings.back().slotClass = 77;
  refused(ErrorId::kBindingUnknown, copy_, bindings);
}

TEST_F(CheckedBindings, StaleHandles) {
  const gpu::Buffer gone = buffer(64);
  device_->destroy(gone);
  refused(ErrorId::kStaleHandle, step_, {gpu::storageBinding(0, {gone})});
  refused(ErrorId::kStaleHandle, copy_, copying({gone}, {from_}, {to_}));
  refused(ErrorId::kStaleHandle, filter_,
          filtering({.texture = {.value = 1}}, gpu::imageBinding(0, result_)));
  refused(ErrorId::kStaleHandle, filter_,
          {gpu::textureBinding(0, {texels_}, {.value = 1}), gpu::imageBinding(0, result_)});
  refused(ErrorId::kStaleHandle, {.value = 1}, {});
}

TEST_F(CheckedBindings, UniformMemoryOfEarlierFramesIsStale) {
  gpu::Commands& commands = inPass();
  const std::vector<std::byte> block(32);
  const gpu::BufferRange range = commands.uniform(block);
  const std::vector<gpu::Binding> bindings = copying(range, {from_}, {to_});
  commands.dispatch({.pipeline = copy_, .bindings = bindings});
  const gpu::BufferRange little = commands.uniform(std::span(block).first(16));
  EXPECT_ERROR(ErrorId::kBindingSmall,
               commands.dispatch({.pipeline = copy_, .bindings = copying(little, {from_}, {to_})}));
  finish(commands);
  refused(ErrorId::kStaleHandle, copy_, bindings);
}

TEST_F(CheckedBindings, RangesOfBuffers) {
  const uint64_t whole = ~uint64_t{0};
  accepted(copy_, copying({uniforms_, 256}, {from_, 512, 256}, {to_, 768}));
  for (const gpu::BufferRange range : {gpu::BufferRange{from_, 1024},
                                       {from_, 0, 1025},
                                       {from_, 256, 769},
                                       {from_, 256, whole},
                                       {from_, 16, 64}}) {
    refused(ErrorId::kBindingRange, copy_, copying({uniforms_}, range, {to_}));
  }
  refused(ErrorId::kBindingRange, copy_, copying({uniforms_, 64, 32}, {from_}, {to_}));
  const gpu::Buffer large = buffer(can_.maxUniformRange + 4, BufferUsage::kUniform);
  refused(ErrorId::kBindingRange, copy_, copying({large}, {from_}, {to_}));
  accepted(copy_, copying({large, 0, can_.maxUniformRange}, {from_}, {to_}));
}

TEST_F(CheckedBindings, BlocksFit) {
  refused(ErrorId::kBindingSmall, copy_, copying({uniforms_, 0, 31}, {from_}, {to_}));
  refused(ErrorId::kBindingSmall, copy_, copying({uniforms_}, {from_, 0, 12}, {to_}));
  accepted(copy_, copying({uniforms_, 0, 32}, {from_, 0, 16}, {to_}));
}

TEST_F(CheckedBindings, UsagesOfBuffersAndTextures) {
  refused(ErrorId::kBufferUsage, copy_, copying({from_}, {from_}, {to_}));
  refused(ErrorId::kBufferUsage, copy_, copying({uniforms_}, {uniforms_}, {to_}));
  refused(ErrorId::kTextureUsage, filter_, filtering({texels_}, gpu::imageBinding(0, texels_)));
  const gpu::Texture target = texture(TextureUsage::kTarget);
  refused(ErrorId::kTextureUsage, filter_, filtering({target}, gpu::imageBinding(0, result_)));
}

TEST_F(CheckedBindings, RangesOfViews) {
  const gpu::Texture levels = texture(TextureUsage::kSampled | TextureUsage::kStorage, {.mips = 3});
  accepted(filter_, filtering({levels}, gpu::imageBinding(0, result_)));
  accepted(filter_, filtering({.texture = levels, .mip = 2}, gpu::imageBinding(0, result_)));
  for (const gpu::TextureView view : {gpu::TextureView{.texture = levels, .mip = 3},
                                      {.texture = levels, .mip = 1, .mipCount = 3},
                                      {.texture = levels, .mip = 1, .mipCount = ~0u},
                                      {.texture = levels, .layer = 1},
                                      {.texture = levels, .layer = 0, .layerCount = 2}}) {
    refused(ErrorId::kBindingRange, filter_, filtering(view, gpu::imageBinding(0, result_)));
  }
  refused(ErrorId::kBindingRange, filter_, filtering({texels_}, gpu::imageBinding(0, levels, 3)));
  gpu::Binding whole = gpu::imageBinding(0, levels);
  whole.view.mipCount = 0;
  refused(ErrorId::kBindingRange, filter_, filtering({texels_}, whole));
}

TEST_F(CheckedBindings, FormatsAndLayers) {
  const gpu::Texture half = texture(TextureUsage::kStorage, {.format = Format::kR16Float});
  refused(ErrorId::kBindingFormat, filter_, filtering({texels_}, gpu::imageBinding(0, half)));
  const gpu::Texture layers =
      texture(TextureUsage::kSampled | TextureUsage::kStorage, {.layers = 3});
  accepted(array_, {gpu::textureBinding(0, {layers}, sampler_)});
  accepted(filter_, filtering({.texture = layers, .layer = 1, .layerCount = 1},
                              gpu::imageBinding(0, result_)));
  accepted(array_, {gpu::textureBinding(0, {texels_}, sampler_)});  // an array of one layer
  refused(ErrorId::kBindingFormat, filter_, filtering({layers}, gpu::imageBinding(0, result_)));
  refused(ErrorId::kBindingFormat, imageStep_, {gpu::imageBinding(0, layers)});
  const gpu::Texture integers = texture(TextureUsage::kSampled, {.format = Format::kR32Uint});
  const gpu::Sampler linear = device_->createSampler({.filter = gpu::Filter::kLinear});
  refused(ErrorId::kBindingFormat, filter_,
          {gpu::textureBinding(0, {integers}, linear), gpu::imageBinding(0, result_)});
}

TEST_F(CheckedBindings, Hazards) {
  refused(ErrorId::kHazard, copy_, copying({uniforms_}, {from_}, {from_}));
  refused(ErrorId::kHazard, copy_, copying({uniforms_}, {from_, 0, 512}, {from_, 256}));
  accepted(copy_, copying({uniforms_}, {from_, 0, 256}, {from_, 256}));
  accepted(step_, {gpu::storageBinding(0, {from_})});
  const gpu::Texture levels =
      texture(TextureUsage::kSampled | TextureUsage::kStorage, {.mips = 3, .layers = 2});
  const auto layered = [&](uint32_t mip, uint32_t layer) {
    gpu::Binding image = gpu::imageBinding(0, levels, mip);
    image.view.layer = layer;
    image.view.layerCount = 1;
    return image;
  };
  const gpu::TextureView top{.texture = levels, .mipCount = 1, .layerCount = 1};
  refused(ErrorId::kHazard, filter_, filtering(top, layered(0, 0)));
  accepted(filter_, filtering(top, layered(1, 0)));
  accepted(filter_, filtering(top, layered(0, 1)));
  const gpu::TextureView all{.texture = levels, .layerCount = 1};
  refused(ErrorId::kHazard, filter_, filtering(all, layered(2, 0)));
}

TEST_F(CheckedBindings, ContentsThatWereNeverWritten) {
  const gpu::Buffer fresh = buffer(64, BufferUsage::kStorage, false);
  refused(ErrorId::kUninitialised, step_, {gpu::storageBinding(0, {fresh})});
  refused(ErrorId::kUninitialised, copy_, copying({uniforms_}, {fresh}, {to_}));
  accepted(copy_, copying({uniforms_}, {from_}, {fresh}));
  accepted(step_, {gpu::storageBinding(0, {fresh})});
  refused(ErrorId::kUninitialised, copy_,
          copying({buffer(64, BufferUsage::kUniform, false)}, {from_}, {to_}));
  // Contents are tracked per subresource.
  const gpu::Texture levels =
      texture(TextureUsage::kSampled | TextureUsage::kStorage, {.mips = 3}, false);
  accepted(filter_, filtering({texels_}, gpu::imageBinding(0, levels, 1)));
  const gpu::TextureView middle{.texture = levels, .mip = 1, .mipCount = 1};
  accepted(filter_, filtering(middle, gpu::imageBinding(0, result_)));
  refused(ErrorId::kUninitialised, filter_, filtering({levels}, gpu::imageBinding(0, result_)));
  refused(ErrorId::kUninitialised, imageStep_, {gpu::imageBinding(0, levels, 2)});
  accepted(imageStep_, {gpu::imageBinding(0, levels, 1)});
}

}  // namespace
}  // namespace grisaille::tests
