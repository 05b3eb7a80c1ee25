// SPDX-License-Identifier: MIT
// Runs instances of the test plugins on a checked null device.
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "core/effect/chain.h"
#include "core/effect/instance.h"
#include "core/effect/values.h"
#include "core/gpu/checking_device.h"
#include "core/gpu/null_device.h"

namespace grisaille::effect {

inline constexpr uint32_t kWidth = 20, kHeight = 12;

struct InstanceTest : testing::Test {
  InstanceTest() {
    auto made = gpu::makeNullDevice();
    null = made.get();
    device = gpu::makeCheckingDevice(std::move(made), [](gpu::Severity, std::string_view text) {
      ADD_FAILURE() << text;  // a leak, reported when the device is destroyed
    });
    registry.scan(PLUGIN_DIR "/sound");
    registry.scan(PLUGIN_DIR "/bad");
    registry.scan(PLUGIN_DIR "/objects");
    viewDepth = makeTexture("view_depth", gpu::Format::kR32Float);
    viewBlock =
        device->createBuffer({.label = "view", .size = 256, .usage = gpu::BufferUsage::kUniform});
    const std::vector<std::byte> zero(kWidth * kHeight * sizeof(float));
    gpu::Commands& commands = device->begin();
    commands.upload(viewDepth, 0, 0, zero);
    commands.upload(viewBlock, 0, std::span(zero).first(256));
    device->submit();
  }
  ~InstanceTest() override {
    for (const gpu::Texture texture : textures) device->destroy(texture);
    device->destroy(viewBlock);
  }

  gpu::Texture makeTexture(const char* label, gpu::Format format) {
    textures.push_back(device->createTexture(
        {.label = label,
         .format = format,
         .width = kWidth,
         .height = kHeight,
         .usage = gpu::TextureUsage::kSampled | gpu::TextureUsage::kStorage}));
    return textures.back();
  }

  // Runs `work` in one frame, with patience, services and objects from `inputs`. Abandons the frame
  // if `work` throws.
  template <typename Work>
  void frame(std::span<const gpu::Texture> outputs, FrameInputs inputs, Work&& work) {
    gpu::Commands& commands = device->begin();
    const grisaille_view view = {};
    inputs.commands = &commands;
    inputs.width = kWidth;
    inputs.height = kHeight;
    inputs.view = &view;
    inputs.viewBlock = {viewBlock, 0, 256};
    inputs.attachments[GRISAILLE_VIEW_DEPTH] = viewDepth;
    inputs.outputs = outputs;
    try {
      work(inputs);
    } catch (...) {
      device->abandon();
      throw;
    }
    device->submit();
  }
  void record(Instance& instance, const Values& values, std::span<const gpu::Texture> outputs,
              const FrameInputs& given = {}) {
    frame(outputs, given, [&](FrameInputs& inputs) {
      inputs.values = values.all();
      instance.record(inputs);
    });
  }
  Report record(Chain& chain, std::string_view effect, std::span<const gpu::Texture> outputs,
                const FrameInputs& given = {}) {
    Report report;
    chain.create();
    frame(outputs, given, [&](FrameInputs& inputs) {
      report = chain.record(*chain.selection.find(effect), inputs);
    });
    return report;
  }

  std::vector<float> texelsOf(gpu::Texture texture) const {
    const std::vector<std::byte> bytes = device->read(texture);
    std::vector<float> texels(bytes.size() / sizeof(float));
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
  }

  template <typename T>
  std::vector<T> recorded() const {
    std::vector<T> found;
    for (const gpu::Recorded& entry : null->recorded()) {
      if (const T* one = std::get_if<T>(&entry)) found.push_back(*one);
    }
    return found;
  }

  gpu::NullDevice* null = nullptr;
  std::unique_ptr<gpu::Device> device;
  Registry registry;
  gpu::Texture viewDepth;
  gpu::Buffer viewBlock;
  std::vector<gpu::Texture> textures;
};

}  // namespace grisaille::effect
