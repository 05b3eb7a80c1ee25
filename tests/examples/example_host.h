// SPDX-License-Identifier: MIT
// An example's effect in a host of the library, which draws pictures made of numbers.
#pragma once

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/examples/built.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"

namespace grisaille::tests {

class ExampleHost : public ::testing::TestWithParam<TestDevice> {
 protected:
  static constexpr uint32_t kWidth = 96, kHeight = 64;

  // Starts a host of the example with this key.
  void start(const char* example) {
    effectKey_ = example;
    host_ = makeHost(GetParam());
    device_.emplace(host_->device(builtExample(example).c_str()));
  }
  void TearDown() override {
    if (host_) {
      EXPECT_EQ(host_->complaints(), 0);
    }
  }

  host::Effect effect(grisaille_host_rows rows = GRISAILLE_HOST_ROWS_FROM_TOP) {
    return {*device_, {.effect = effectKey_, .width = kWidth, .height = kHeight, .rows = rows}};
  }
  // Textures from a function of the pixel's centre, rows from the top.
  template <typename Of>
  host::Texture numbers(Of&& of) {
    return host_->texture(*device_, Texels::kFloat1, kWidth, kHeight, texels(of, 1));
  }
  template <typename Of>
  host::Texture colours(Of&& of) {
    return host_->texture(*device_, Texels::kFloat4, kWidth, kHeight, texels(of, 4));
  }
  // Records a frame, whose depth is metres along the view direction, and reads the first output.
  std::vector<float> record(host::Effect& effect, host::Frame frame) {
    host_->frame([&](void* commands, uint64_t number) {
      frame.number = number;
      frame.commandBuffer = commands;
      frame.depthKind = GRISAILLE_HOST_DEPTH_VIEW;
      effect.record(frame);
    });
    const auto tables = device_->effects();
    const auto table = std::ranges::find(tables, std::string_view(effectKey_), [](const auto* one) {
      return std::string_view(one->key);
    });
    return host_->read(effect.output((*table)->outputs[0].key));
  }

  // Expects that the recording is refused with 5610 and this text.
  void expectLacks(host::Effect& effect, host::Frame frame, const std::string& text) {
    host_->frame([&](void* commands, uint64_t number) {
      frame.number = number;
      frame.commandBuffer = commands;
      try {
        effect.record(frame);
        ADD_FAILURE() << "it ran";
      } catch (const host::Failure& failure) {
        EXPECT_EQ(failure.number(), 5610);
        EXPECT_NE(std::string(failure.what()).find(text), std::string::npos) << failure.what();
      }
    });
  }

  const char* effectKey_ = nullptr;
  std::unique_ptr<Host> host_;
  std::optional<host::Device> device_;

 private:
  // `of` returns a number, which fills all channels but alpha.
  template <typename Of>
  static std::vector<float> texels(Of&& of, size_t channels) {
    std::vector<float> all;
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const auto value = static_cast<float>(of(x + 0.5, y + 0.5));
        for (size_t c = 0; c < channels; ++c) all.push_back(c == 3 ? 1.0f : value);
      }
    }
    return all;
  }
};

}  // namespace grisaille::tests
