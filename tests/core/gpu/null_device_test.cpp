// SPDX-License-Identifier: MIT
#include "core/gpu/null_device.h"

#include "tests/core/gpu/checked_null.h"

namespace grisaille::gpu {
namespace {

using tests::kFilter;

std::vector<std::byte> bytesOf(size_t count, int seed) {
  std::vector<std::byte> bytes(count);
  for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 + seed);
  return bytes;
}

TEST(NullDevice, KeepsUploads) {
  const std::unique_ptr<NullDevice> device = makeNullDevice();
  const Buffer buffer = device->createBuffer({.label = "b", .size = 100});
  const Texture texture = device->createTexture(
      {.label = "t", .format = Format::kR32Float, .width = 5, .height = 3, .mips = 2, .layers = 2});
  Commands& commands = device->begin();
  const std::vector<std::byte> part = bytesOf(10, 1), level = bytesOf(2 * 1 * 4, 2);
  commands.upload(buffer, 20, part);
  commands.upload(texture, 1, 1, level);
  device->submit();
  EXPECT_EQ(device->read({.buffer = buffer, .offset = 20, .size = 10}), part);
  EXPECT_EQ(device->read({.buffer = buffer, .offset = 30}), std::vector<std::byte>(70));
  EXPECT_EQ(device->read(texture, 1, 1), level);
  EXPECT_EQ(device->read(texture, 0, 0), std::vector<std::byte>(5 * 3 * 4));
}

// A mip chain in one pass: each dispatch is preceded by the barriers for its two mips.
TEST(NullDevice, RecordsCallsAndBarriersInOrder) {
  const std::unique_ptr<NullDevice> device = makeNullDevice();
  const Texture texture = device->createTexture({.label = "chain",
                                                 .format = Format::kR32Float,
                                                 .width = 8,
                                                 .height = 8,
                                                 .mips = 3,
                                                 .usage = TextureUsage::kStorage});
  const ComputePipeline pipeline =
      device->createComputePipeline({.label = "filter", .shader = &kFilter});
  Commands& commands = device->begin();
  commands.upload(texture, 0, 0, bytesOf(256, 0));
  commands.beginPass("chain");
  for (uint32_t mip = 1; mip < 3; ++mip) {
    const Binding bindings[] = {
        textureBinding(0, {.texture = texture, .mip = mip - 1, .mipCount = 1}, {}),
        imageBinding(0, texture, mip)};
    commands.dispatch({.pipeline = pipeline, .bindings = bindings, .groups = {mip, 1, 1}});
  }
  commands.endPass();
  device->submit();
  const std::vector<Recorded>& recorded = device->recorded();
  ASSERT_EQ(recorded.size(), 8u);
  EXPECT_EQ(std::get<RecordedUpload>(recorded[1]).bytes, 256u);
  EXPECT_EQ(std::get<RecordedPass>(recorded[2]).label, "chain");
  for (uint32_t mip = 1; mip < 3; ++mip) {
    const auto& barriers = std::get<RecordedBarriers>(recorded[1 + mip * 2]).transitions;
    ASSERT_EQ(barriers.size(), 2u);
    EXPECT_EQ(barriers[0].mip, mip - 1);
    EXPECT_EQ(barriers[0].before, mip == 1 ? Access::kCopyWrite : Access::kStorageWrite);
    EXPECT_EQ(barriers[0].after, Access::kSampled);
    EXPECT_EQ(barriers[1].mip, mip);
    EXPECT_EQ(barriers[1].before, Access::kNone);
    EXPECT_EQ(barriers[1].after, Access::kStorageWrite);
    const auto& dispatch = std::get<RecordedDispatch>(recorded[2 + mip * 2]);
    EXPECT_EQ(dispatch.pipeline, "filter");
    EXPECT_EQ(dispatch.groups[0], mip);
    EXPECT_EQ(dispatch.bindings.size(), 2u);
  }
  EXPECT_FALSE(std::get<RecordedPass>(recorded[7]).begins);
}

TEST(NullDevice, AnAbandonedFramesUsesAreForgotten) {
  const std::unique_ptr<NullDevice> device = makeNullDevice();
  const Buffer buffer = device->createBuffer({.label = "b", .size = 16});
  device->begin().upload(buffer, 0, bytesOf(16, 0));
  device->abandon();
  device->abandon();
  device->begin().upload(buffer, 0, bytesOf(16, 0));
  const auto& barriers = std::get<RecordedBarriers>(device->recorded()[0]).transitions;
  EXPECT_EQ(barriers[0].before, Access::kNone);
  device->submit();
}

TEST(NullDevice, StaleHandlesAreFound) {
  const std::unique_ptr<NullDevice> device = makeNullDevice();
  const Sampler sampler = device->createSampler({});
  device->destroy(sampler);
  EXPECT_ERROR(ErrorId::kStaleHandle, device->destroy(sampler));
  EXPECT_ERROR(ErrorId::kStaleHandle, device->destroy(ComputePipeline{.value = 0x10000}));
}

}  // namespace
}  // namespace grisaille::gpu
