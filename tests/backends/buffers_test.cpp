// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "shaders/fill_comp.h"
#include "tests/support/devices.h"

namespace grisaille::tests {
namespace {

using gpu::BufferUsage;

class Buffers : public BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(Buffers);

std::vector<uint32_t> counting(size_t count, uint32_t first = 0) {
  std::vector<uint32_t> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

TEST_P(Buffers, HoldWhatIsUploaded) {
  for (const BufferUsage usage :
       {BufferUsage::kVertex, BufferUsage::kIndex, BufferUsage::kUniform, BufferUsage::kStorage}) {
    const std::vector<uint32_t> values = counting(1001, 17);
    EXPECT_EQ(readBuffer<uint32_t>({.buffer = bufferOf(values, usage)}), values);
  }
}

TEST_P(Buffers, OfOneByteHoldIt) {
  const std::vector<uint8_t> one = {0xa7};
  EXPECT_EQ(readBuffer<uint8_t>({.buffer = bufferOf(one, BufferUsage::kStorage)}), one);
}

TEST_P(Buffers, UploadsReplaceOnlyTheirRange) {
  std::vector<uint8_t> expected(997);
  for (size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<uint8_t>(i * 7);
  const gpu::Buffer buffer = bufferOf(expected, BufferUsage::kStorage);
  const std::vector<uint8_t> patch = {1, 2, 3, 4, 5};
  for (const size_t offset : {size_t{0}, size_t{1}, size_t{333}, expected.size() - patch.size()}) {
    inFrame([&](gpu::Commands& commands) {
      commands.upload(buffer, offset, std::as_bytes(std::span(patch)));
    });
    std::copy(patch.begin(), patch.end(), expected.begin() + static_cast<ptrdiff_t>(offset));
  }
  EXPECT_EQ(readBuffer<uint8_t>({.buffer = buffer}), expected);
}

TEST_P(Buffers, ReadsGiveTheirRange) {
  const gpu::Buffer buffer = bufferOf(counting(300), BufferUsage::kStorage);
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffer, .offset = 40, .size = 80}), counting(20, 10));
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffer, .offset = 1000}), counting(50, 250));
}

TEST_P(Buffers, LargeUploadsArrive) {
  const std::vector<uint32_t> values = counting(size_t{5} << 20);  // 20 MiB
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = bufferOf(values, BufferUsage::kStorage)}), values);
}

// The call copies the bytes. Work recorded before an upload sees the old contents, later work the
// new.
TEST_P(Buffers, UploadsAndDispatchesOfOneFrameKeepTheirOrder) {
  const gpu::Buffer buffer = makeBuffer(256 * 4, BufferUsage::kStorage);
  const gpu::ComputePipeline fill = makeCompute(grisaille_shader_fill_comp);
  inFrame([&](gpu::Commands& commands) {
    std::vector<uint32_t> values = counting(256, 5000);
    commands.upload(buffer, 0, std::as_bytes(std::span(values)));
    values.assign(values.size(), 0xffffffffu);
    commands.beginPass("fill");
    const std::array<uint32_t, 4> block = {128, 2, 1, 0};
    const gpu::Binding bindings[] = {
        gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(block)))),
        gpu::storageBinding(0, {.buffer = buffer})};
    commands.dispatch({.pipeline = fill, .bindings = bindings, .groups = {2, 1, 1}});
    commands.endPass();
    const std::vector<uint32_t> patch = {42};
    commands.upload(buffer, 12, std::as_bytes(std::span(patch)));
  });
  std::vector<uint32_t> expected = counting(256, 5000);
  for (uint32_t i = 0; i < 128; ++i) expected[i] = i * 2 + 1;
  expected[3] = 42;
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffer}), expected);
}

TEST_P(Buffers, AreBoundAtTheirOffset) {
  const uint32_t alignment = device().info().capabilities.storageAlignment;
  const uint32_t words = (alignment + 3) / 4;
  const gpu::Buffer buffer = bufferOf(counting(words + 64), BufferUsage::kStorage);
  const gpu::ComputePipeline fill = makeCompute(grisaille_shader_fill_comp);
  inFrame([&](gpu::Commands& commands) {
    const std::array<uint32_t, 4> block = {64, 0, 9, 0};
    const gpu::Binding bindings[] = {
        gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(block)))),
        gpu::storageBinding(0, {.buffer = buffer, .offset = words * 4, .size = 64 * 4})};
    commands.beginPass("fill");
    commands.dispatch({.pipeline = fill, .bindings = bindings});
    commands.endPass();
  });
  std::vector<uint32_t> expected = counting(words + 64);
  std::fill(expected.begin() + words, expected.end(), 9u);
  EXPECT_EQ(readBuffer<uint32_t>({.buffer = buffer}), expected);
}

TEST_P(Buffers, ServeAsUniformBuffers) {
  const uint32_t alignment = device().info().capabilities.uniformAlignment;
  const uint32_t words = std::max(4u, (alignment + 3) / 4);
  std::vector<uint32_t> blocks(words + 4, 0);
  blocks[words] = 64;
  blocks[words + 1] = 3;
  blocks[words + 2] = 11;
  const gpu::Buffer uniforms = bufferOf(blocks, BufferUsage::kUniform);
  const gpu::Buffer out = makeBuffer(64 * 4, BufferUsage::kStorage);
  const gpu::Binding bindings[] = {
      gpu::uniformBinding(0, {.buffer = uniforms, .offset = words * 4, .size = 16}),
      gpu::storageBinding(0, {.buffer = out})};
  compute({.pipeline = makeCompute(grisaille_shader_fill_comp), .bindings = bindings});
  const std::vector<uint32_t> values = readBuffer<uint32_t>({.buffer = out});
  for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ(values[i], i * 3 + 11);
}

}  // namespace
}  // namespace grisaille::tests
