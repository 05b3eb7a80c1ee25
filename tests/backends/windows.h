// SPDX-License-Identifier: MIT
// A window with a device, on a private display.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <thread>

#include "backends/backends.h"
#include "backends/glfw/window.h"
#include "tests/support/devices.h"
#include "tests/support/display.h"

namespace grisaille::tests {

class WindowTest : public ::testing::TestWithParam<TestDevice> {
 protected:
  static constexpr uint32_t kScreen = 4096;  // pixels per side

  void SetUp() override {
    const std::string why = whyAbsent(GetParam());
    if (!why.empty()) GTEST_SKIP() << why;
    driver_ = std::make_unique<DriverScope>(GetParam());
    display_ = std::make_unique<Display>(kScreen, kScreen);
    glfwSetErrorCallback([](int, const char* text) { ADD_FAILURE() << "GLFW says: " << text; });
    glfw::choosePlatform();
    ASSERT_EQ(glfwInit(), GLFW_TRUE);
  }
  void TearDown() override {
    close();
    glfwTerminate();
    display_.reset();
    driver_.reset();
  }

  GLFWwindow* makeWindow(uint32_t width, uint32_t height,
                         const std::string& backend = GetParam().backend) {
    glfw::hintWindow(backend, true);
    glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), "test",
                                          nullptr, nullptr);
    if (window == nullptr) throw std::runtime_error("GLFW cannot create a window");
    glfwSetWindowPos(window, 0, 0);
    return window;
  }
  gpu::DeviceOptions optionsFor(GLFWwindow* window) {
    gpu::DeviceOptions options;
    options.check = true;
    options.message = [](gpu::Severity severity, std::string_view text) {
      ADD_FAILURE() << "severity " << static_cast<int>(severity) << ": " << text;
    };
    options.window = &surfaces_.emplace_back(window);
    return options;
  }

  // Opens the test's window and its device.
  void open(uint32_t width, uint32_t height) {
    window_ = makeWindow(width, height);
    device_ = backends::create(GetParam().backend, optionsFor(window_));
  }
  void close() {
    device_.reset();
    if (window_ != nullptr) glfwDestroyWindow(window_);
    window_ = nullptr;
  }
  GLFWwindow* window() { return window_; }
  gpu::Device& device() { return *device_; }
  const Display& display() { return *display_; }

  // A picture without symmetry: quadrants of different colours with a pattern inside.
  static uint32_t texel(uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    constexpr uint32_t kQuadrants[] = {0xc01020, 0x10c030, 0x2040c0, 0xc0c040};  // 0xRRGGBB
    const uint32_t quadrant = (x >= width / 2 ? 1u : 0u) + (y >= height / 2 ? 2u : 0u);
    return kQuadrants[quadrant] ^ ((x * 7 + y * 13) % 16 * 0x010101);
  }
  gpu::Texture makePicture(gpu::Device& device, uint32_t width, uint32_t height) {
    const gpu::Texture picture = device.createTexture({.label = "picture",
                                                       .format = gpu::Format::kRgba8Unorm,
                                                       .width = width,
                                                       .height = height,
                                                       .usage = gpu::TextureUsage::kSampled});
    std::vector<uint8_t> bytes;
    for (uint32_t i = 0; i < width * height; ++i) {
      const uint32_t color = texel(i % width, i / width, width, height);
      for (const uint32_t byte : {color >> 16, color >> 8, color, 128u}) {
        bytes.push_back(static_cast<uint8_t>(byte & 255u));
      }
    }
    device.begin().upload(picture, 0, 0, std::as_bytes(std::span(bytes)));
    device.submit();
    return picture;
  }

  // Presents until the window accepts the picture, as applications do after a resize.
  void show(gpu::Texture picture) {
    for (int attempt = 0; attempt < 50; ++attempt) {
      glfwPollEvents();
      if (device().present(picture)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "the window accepted no picture";
  }

  // Waits until the window's top left pixels match: the X server draws asynchronously.
  template <typename Expected>
  void expectShown(uint32_t width, uint32_t height, Expected&& expected) {
    std::vector<uint32_t> wanted;
    for (uint32_t i = 0; i < width * height; ++i) {
      wanted.push_back(expected(i % width, i / width));
    }
    std::vector<uint32_t> there = display().pixels(0, 0, width, height);
    for (int attempt = 0; attempt < 200 && there != wanted; ++attempt) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      there = display().pixels(0, 0, width, height);
    }
    const auto [here, first] = std::mismatch(there.begin(), there.end(), wanted.begin());
    if (here == there.end()) return;
    const auto at = static_cast<uint32_t>(here - there.begin());
    ADD_FAILURE() << "pixel " << at % width << ", " << at / width << " is " << std::hex << *here
                  << ", not " << *first;
  }

  // Expects a picture at the window's top left, black elsewhere.
  void expectPicture(uint32_t width, uint32_t height, uint32_t pictureWidth,
                     uint32_t pictureHeight) {
    expectShown(width, height, [&](uint32_t x, uint32_t y) {
      const bool inside = x < pictureWidth && y < pictureHeight;
      return inside ? texel(x, y, pictureWidth, pictureHeight) : 0u;
    });
  }

 private:
  std::unique_ptr<DriverScope> driver_;
  std::unique_ptr<Display> display_;
  GLFWwindow* window_ = nullptr;
  std::deque<glfw::Window> surfaces_;  // as devices see windows; both kinds outlive devices
  std::unique_ptr<gpu::Device> device_;
};

}  // namespace grisaille::tests
