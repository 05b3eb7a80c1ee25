// SPDX-License-Identifier: MIT
#include "tests/core/gpu/checked_null.h"

namespace grisaille::tests {
namespace {

class CheckedRecording : public CheckedNull {
 protected:
  gpu::TextureDesc transientDesc() {
    return {.label = "t",
            .format = Format::kR32Float,
            .width = 4,
            .height = 4,
            .usage = TextureUsage::kStorage};
  }
};

TEST_F(CheckedRecording, OnlyBetweenBeginAndSubmit) {
  const gpu::Buffer data = buffer(64);
  const gpu::ComputePipeline step = compute(kStep);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = data})};
  gpu::Commands& commands = inPass();
  finish(commands);
  const std::vector<std::byte> bytes(4);
  EXPECT_ERROR(ErrorId::kNotRecording, device_->submit());
  EXPECT_ERROR(ErrorId::kNotRecording, commands.beginPass("late"));
  EXPECT_ERROR(ErrorId::kNotRecording, commands.endPass());
  EXPECT_ERROR(ErrorId::kNotRecording, commands.render({}));
  EXPECT_ERROR(ErrorId::kNotRecording, commands.dispatch({.pipeline = step, .bindings = bindings}));
  EXPECT_ERROR(ErrorId::kNotRecording, commands.uniform(bytes));
  EXPECT_ERROR(ErrorId::kNotRecording, commands.transient(transientDesc()));
  EXPECT_ERROR(ErrorId::kNotRecording, commands.upload(data, 0, bytes));
  EXPECT_ERROR(ErrorId::kNotRecording, commands.upload(gpu::Texture{}, 0, 0, bytes));
}

TEST_F(CheckedRecording, NothingElseMeanwhile) {
  const gpu::Buffer data = buffer(64);
  const gpu::Texture texels = texture(TextureUsage::kSampled);
  device_->begin();
  EXPECT_ERROR(ErrorId::kAlreadyRecording, device_->begin());
  EXPECT_ERROR(ErrorId::kAlreadyRecording, (void)device_->read(gpu::BufferRange{.buffer = data}));
  EXPECT_ERROR(ErrorId::kAlreadyRecording, (void)device_->read(texels));
  device_->submit();
  EXPECT_EQ(device_->read(gpu::BufferRange{.buffer = data}).size(), 64u);
}

// Valid calls reach the null device, which has no window.
TEST_F(CheckedRecording, PresentsAPictureBetweenFrames) {
  const gpu::TextureDesc picture{.format = Format::kRgba8Unorm, .width = 4, .height = 4};
  const gpu::Texture valid = texture(TextureUsage::kSampled, picture);
  EXPECT_ERROR(ErrorId::kNoWindow, (void)device_->present(valid));
  EXPECT_ERROR(ErrorId::kUninitialised,
               (void)device_->present(texture(TextureUsage::kSampled, picture, false)));
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device_->present({}));
  for (const Format format : {Format::kR32Float, Format::kRgba8Srgb, Format::kD32Float}) {
    const gpu::Texture other = texture(TextureUsage::kSampled, {.format = format});
    EXPECT_ERROR(ErrorId::kTextureFormat, (void)device_->present(other));
  }
  gpu::Commands& commands = device_->begin();
  EXPECT_ERROR(ErrorId::kAlreadyRecording, (void)device_->present(valid));
  const gpu::Texture transient = commands.transient(transientDesc());
  device_->submit();
  EXPECT_ERROR(ErrorId::kTransientStale, (void)device_->present(transient));
  device_->destroy(valid);
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device_->present(valid));
}

TEST_F(CheckedRecording, PassesDoNotNest) {
  gpu::Commands& commands = inPass();
  EXPECT_ERROR(ErrorId::kPassNesting, commands.beginPass("inner"));
  EXPECT_ERROR(ErrorId::kPassNesting, device_->submit());
  finish(commands);
}

TEST_F(CheckedRecording, WorkNeedsAPass) {
  const gpu::Buffer data = buffer(64);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = data})};
  const gpu::ComputePipeline step = compute(kStep);
  gpu::Commands& commands = device_->begin();
  EXPECT_ERROR(ErrorId::kPassMissing, commands.dispatch({.pipeline = step, .bindings = bindings}));
  EXPECT_ERROR(ErrorId::kPassMissing, commands.render({}));
  EXPECT_ERROR(ErrorId::kPassMissing, commands.endPass());
  device_->submit();
}

TEST_F(CheckedRecording, DispatchSizes) {
  const gpu::Buffer data = buffer(64);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = data})};
  const gpu::ComputePipeline step = compute(kStep);
  gpu::Commands& commands = inPass();
  for (size_t axis = 0; axis < 3; ++axis) {
    gpu::Dispatch dispatch{.pipeline = step, .bindings = bindings};
    dispatch.groups[axis] = can_.maxGroups[axis];
    commands.dispatch(dispatch);
    for (const uint32_t groups : {0u, can_.maxGroups[axis] + 1}) {
      dispatch.groups[axis] = groups;
      EXPECT_ERROR(ErrorId::kDispatchSize, commands.dispatch(dispatch));
    }
  }
  finish(commands);
}

TEST_F(CheckedRecording, UniformSizes) {
  gpu::Commands& commands = device_->begin();
  const std::vector<std::byte> bytes(65537);
  EXPECT_ERROR(ErrorId::kUniformSize, commands.uniform({}));
  EXPECT_ERROR(ErrorId::kUniformSize, commands.uniform(bytes));
  EXPECT_EQ(commands.uniform(std::span(bytes).first(65536)).size, 65536u);
  device_->submit();
}

TEST_F(CheckedRecording, UploadRanges) {
  const gpu::Buffer data = buffer(64);
  const gpu::Texture texels = texture(TextureUsage::kSampled, {.mips = 3, .layers = 2});
  const std::vector<std::byte> bytes(16 * 16 * 4 + 1);
  const auto first = [&](size_t count) { return std::span(bytes).first(count); };
  gpu::Commands& commands = device_->begin();
  commands.upload(data, 60, first(4));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(data, 0, {}));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(data, 61, first(4)));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(data, 64, first(1)));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(data, ~uint64_t{0}, first(2)));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(data, 0, first(65)));
  commands.upload(texels, 2, 1, first(4 * 4 * 4));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(texels, 0, 0, first(16 * 16 * 4 - 1)));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(texels, 0, 0, first(16 * 16 * 4 + 1)));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(texels, 3, 0, first(2 * 2 * 4)));
  EXPECT_ERROR(ErrorId::kUploadRange, commands.upload(texels, 0, 2, first(16 * 16 * 4)));
  device_->submit();
}

TEST_F(CheckedRecording, ReadbackRanges) {
  const gpu::Buffer data = buffer(64);
  const gpu::Texture texels = texture(TextureUsage::kSampled, {.mips = 3, .layers = 2});
  EXPECT_EQ(device_->read({.buffer = data, .offset = 63}).size(), 1u);
  EXPECT_ERROR(ErrorId::kReadbackRange, (void)device_->read({.buffer = data, .offset = 64}));
  EXPECT_ERROR(ErrorId::kReadbackRange,
               (void)device_->read({.buffer = data, .offset = 60, .size = 5}));
  EXPECT_ERROR(ErrorId::kReadbackRange,
               (void)device_->read({.buffer = data, .offset = 1, .size = ~uint64_t{0}}));
  EXPECT_EQ(device_->read(texels, 2, 1).size(), 64u);
  EXPECT_ERROR(ErrorId::kReadbackRange, (void)device_->read(texels, 3, 0));
  EXPECT_ERROR(ErrorId::kReadbackRange, (void)device_->read(texels, 0, 2));
}

TEST_F(CheckedRecording, ReadingBackNeedsContents) {
  const gpu::Buffer data = buffer(64, BufferUsage::kStorage, false);
  const gpu::Texture texels = texture(TextureUsage::kSampled, {.mips = 2}, false);
  EXPECT_ERROR(ErrorId::kUninitialised, (void)device_->read(gpu::BufferRange{.buffer = data}));
  const std::vector<std::byte> level(8 * 8 * 4);
  device_->begin().upload(texels, 1, 0, level);
  device_->submit();
  EXPECT_EQ(device_->read(texels, 1), level);
  EXPECT_ERROR(ErrorId::kUninitialised, (void)device_->read(texels, 0));
  // Writes of an abandoned frame do not count as contents.
  const std::vector<std::byte> top(16 * 16 * 4);
  gpu::Commands& commands = device_->begin();
  commands.upload(texels, 0, 0, top);
  commands.upload(data, 0, std::span(top).first(64));
  device_->abandon();
  EXPECT_ERROR(ErrorId::kUninitialised, (void)device_->read(texels, 0));
  EXPECT_ERROR(ErrorId::kUninitialised, (void)device_->read(gpu::BufferRange{.buffer = data}));
  EXPECT_EQ(device_->read(texels, 1), level);
}

TEST_F(CheckedRecording, TransientTexturesEndWithTheirFrame) {
  const gpu::ComputePipeline step = compute(kImageStep);
  const std::vector<std::byte> bytes(4 * 4 * 4);
  gpu::Commands& commands = inPass();
  const gpu::Texture transient = commands.transient(transientDesc());
  commands.upload(transient, 0, 0, bytes);
  const gpu::Binding bindings[] = {gpu::imageBinding(0, transient)};
  commands.dispatch({.pipeline = step, .bindings = bindings});
  EXPECT_ERROR(ErrorId::kTransientStale, device_->destroy(transient));
  finish(commands);
  EXPECT_ERROR(ErrorId::kTransientStale, device_->destroy(transient));
  EXPECT_ERROR(ErrorId::kTransientStale, (void)device_->read(transient));
  inPass();
  EXPECT_ERROR(ErrorId::kTransientStale,
               commands.dispatch({.pipeline = step, .bindings = bindings}));
  EXPECT_ERROR(ErrorId::kTransientStale, commands.upload(transient, 0, 0, bytes));
  // The pool reuses the texture; its contents are undefined again.
  EXPECT_EQ(commands.transient(transientDesc()), transient);
  EXPECT_ERROR(ErrorId::kUninitialised,
               commands.dispatch({.pipeline = step, .bindings = bindings}));
  finish(commands);
  gpu::TextureDesc wrong = transientDesc();
  wrong.width = 0;
  device_->begin();
  EXPECT_ERROR(ErrorId::kTextureSize, commands.transient(wrong));
  device_->submit();
}

TEST_F(CheckedRecording, WhatTheFrameUsesStays) {
  const gpu::Buffer data = buffer(64), other = buffer(64);
  const gpu::Texture texels = texture(TextureUsage::kSampled);
  const gpu::ComputePipeline step = compute(kStep);
  const gpu::Binding bindings[] = {gpu::storageBinding(0, {.buffer = data})};
  gpu::Commands& commands = inPass();
  commands.dispatch({.pipeline = step, .bindings = bindings});
  commands.upload(texels, 0, 0, std::vector<std::byte>(16 * 16 * 4));
  EXPECT_ERROR(ErrorId::kDestroyedInUse, device_->destroy(data));
  EXPECT_ERROR(ErrorId::kDestroyedInUse, device_->destroy(step));
  EXPECT_ERROR(ErrorId::kDestroyedInUse, device_->destroy(texels));
  device_->destroy(other);
  finish(commands);
  device_->destroy(data);
  device_->destroy(step);
  device_->destroy(texels);
  device_.reset();
  EXPECT_TRUE(messages_.empty());
}

}  // namespace
}  // namespace grisaille::tests
