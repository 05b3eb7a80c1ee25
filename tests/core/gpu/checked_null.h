// SPDX-License-Identifier: MIT
// The checking device over the null device, with hand-written shader reflections: the checks read
// nothing else of a shader.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/gpu/checking_device.h"
#include "core/gpu/null_device.h"
#include "tests/support/expect_error.h"

namespace grisaille::tests {

inline constexpr uint32_t kNoCode[] = {0};

template <size_t kSlots>
constexpr gpu::Shader computeShader(const char* name,
                                    const grisaille_shader_slot (&slots)[kSlots]) {
  gpu::Shader shader{};
  shader.struct_size = sizeof(gpu::Shader);
  shader.stage = GRISAILLE_STAGE_COMPUTE;
  shader.name = name;
  shader.spirv = kNoCode;
  shader.spirv_words = 1;
  shader.glsl = "";
  shader.slots = slots;
  shader.slot_count = kSlots;
  return shader;
}

// A uniform block of 32 bytes; buffers with a fixed part of 16 bytes, for reading, writing and
// both.
inline constexpr grisaille_shader_slot kCopySlots[] = {
    {GRISAILLE_SLOT_UNIFORM, 0, 1, 0, 32, 0, "", "Values"},
    {GRISAILLE_SLOT_STORAGE, 0, 1, 0, 16, 0, "", "From"},
    {GRISAILLE_SLOT_STORAGE, 1, 0, 1, 16, 0, "", "To"}};
inline constexpr gpu::Shader kCopy = computeShader("copy", kCopySlots);

inline constexpr grisaille_shader_slot kStepSlots[] = {
    {GRISAILLE_SLOT_STORAGE, 0, 1, 1, 16, 0, "", "Data"}};
inline constexpr gpu::Shader kStep = computeShader("step", kStepSlots);

inline constexpr grisaille_shader_slot kFilterSlots[] = {
    {GRISAILLE_SLOT_TEXTURE, 0, 1, 0, 0, 0, "", "source"},
    {GRISAILLE_SLOT_IMAGE, 0, 0, 1, 0, 0, "r32f", "result"}};
inline constexpr gpu::Shader kFilter = computeShader("filter", kFilterSlots);

inline constexpr grisaille_shader_slot kImageStepSlots[] = {
    {GRISAILLE_SLOT_IMAGE, 0, 1, 1, 0, 0, "r32f", "data"}};
inline constexpr gpu::Shader kImageStep = computeShader("image step", kImageStepSlots);

inline constexpr grisaille_shader_slot kArraySlots[] = {
    {GRISAILLE_SLOT_TEXTURE, 0, 1, 0, 0, 1, "", "layers"}};
inline constexpr gpu::Shader kArray = computeShader("array", kArraySlots);

inline constexpr grisaille_shader_constant kConstantRows[] = {
    {3, GRISAILLE_SCALAR_UINT, 0, "kCount"}, {4, GRISAILLE_SCALAR_BOOL, 0, "kFlag"}};
inline constexpr gpu::Shader kWithConstants = [] {
  gpu::Shader shader = kStep;
  shader.constants = kConstantRows;
  shader.constant_count = 2;
  return shader;
}();

inline constexpr grisaille_shader_location kInputs[] = {{0, GRISAILLE_SCALAR_FLOAT, 3, "position"},
                                                        {1, GRISAILLE_SCALAR_FLOAT, 2, "uv"}};
inline constexpr gpu::Shader kVertex = [] {
  gpu::Shader shader = kStep;
  shader.stage = GRISAILLE_STAGE_VERTEX;
  shader.name = "vertex";
  shader.slot_count = 0;
  shader.inputs = kInputs;
  shader.input_count = 2;
  return shader;
}();

inline constexpr grisaille_shader_location kOutputs[] = {{0, GRISAILLE_SCALAR_FLOAT, 4, "color"}};
inline constexpr grisaille_shader_slot kFragmentSlots[] = {
    {GRISAILLE_SLOT_TEXTURE, 2, 1, 0, 0, 0, "", "albedo"}};
inline constexpr gpu::Shader kFragment = [] {
  gpu::Shader shader = computeShader("fragment", kFragmentSlots);
  shader.stage = GRISAILLE_STAGE_FRAGMENT;
  shader.outputs = kOutputs;
  shader.output_count = 1;
  return shader;
}();

class CheckedNull : public ::testing::Test {
 protected:
  using BufferUsage = gpu::BufferUsage;
  using TextureUsage = gpu::TextureUsage;
  using Format = gpu::Format;

  // The device's messages, including leaks when it is destroyed.
  std::vector<std::string> messages_;
  std::unique_ptr<gpu::Device> device_ = gpu::makeCheckingDevice(
      gpu::makeNullDevice(), [this](gpu::Severity severity, std::string_view text) {
        EXPECT_EQ(severity, gpu::Severity::kError);
        messages_.emplace_back(text);
      });
  const gpu::Capabilities& can_ = device_->info().capabilities;

  gpu::Buffer buffer(uint64_t size, BufferUsage usage = BufferUsage::kStorage,
                     bool written = true) {
    const gpu::Buffer made =
        device_->createBuffer({.label = "a buffer", .size = size, .usage = usage});
    if (written) {
      const std::vector<std::byte> bytes(size);
      device_->begin().upload(made, 0, bytes);
      device_->submit();
    }
    return made;
  }
  gpu::Texture texture(TextureUsage usage, gpu::TextureDesc desc = {}, bool written = true) {
    desc.label = "a texture";
    desc.usage = usage;
    if (desc.format == Format::kNone) desc.format = Format::kR32Float;
    if (desc.width == 0) desc.width = desc.height = 16;
    const gpu::Texture made = device_->createTexture(desc);
    if (written) {
      gpu::Commands& commands = device_->begin();
      for (uint32_t i = 0; i < desc.mips * desc.layers; ++i) {
        const uint32_t mip = i % desc.mips;
        const std::vector<std::byte> bytes(size_t{std::max(1u, desc.width >> mip)} *
                                           std::max(1u, desc.height >> mip) *
                                           gpu::formatInfo(desc.format).texelBytes);
        commands.upload(made, mip, i / desc.mips, bytes);
      }
      device_->submit();
    }
    return made;
  }
  gpu::ComputePipeline compute(const gpu::Shader& shader) {
    return device_->createComputePipeline({.label = shader.name, .shader = &shader});
  }
  // Begins a frame and a pass in it.
  gpu::Commands& inPass() {
    gpu::Commands& commands = device_->begin();
    commands.beginPass("test");
    return commands;
  }
  void finish(gpu::Commands& commands) {
    commands.endPass();
    device_->submit();
  }
};

}  // namespace grisaille::tests
