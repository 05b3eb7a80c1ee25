// SPDX-License-Identifier: MIT
// Hosts of the library for tests. Each has its own Vulkan device or OpenGL context, textures made
// from numbers, and frames that it waits for.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grisaille/host.hpp"
#include "tests/support/test_device.h"

namespace grisaille::tests {

enum class Texels : uint8_t {
  kFloat1,
  kFloat4,
  kHalf4,
  kUnorm8x4,
  kUnorm16x2,
  kUnorm10x3,  // RGB10A2; three numbers a texel
  kDepth16,
  kDepth24,  // without stencil
  kDepth24Stencil,
  kDepth32,
  kDepth32Stencil,
};

class Host {
 public:
  virtual ~Host() = default;

  // `effectFolder`: folder of further effects; null: none.
  virtual host::Device device(const char* effectFolder = nullptr, uint32_t flags = 0,
                              const grisaille_host_log* log = nullptr) = 0;

  // Creates a texture of the host and wraps it. `numbers` holds the channels of each texel, with
  // rows in memory order, and layers one after the other. The texture lives as long as the host. It
  // is an array if `layers` is over 0.
  virtual host::Texture texture(const host::Device& device, Texels texels, uint32_t width,
                                uint32_t height, const std::vector<float>& numbers,
                                uint32_t layers = 0) = 0;
  // Whether the device has textures of this kind: some lack depth of 24 bits.
  virtual bool has(Texels texels) const = 0;
  // The description that wraps the last texture.
  virtual host::TextureSpec described() const = 0;

  // Runs a frame: calls `record` with the command buffer and the frame's number, then submits.
  virtual void frame(const std::function<void(void*, uint64_t)>& record) = 0;

  // Records a frame, and drops its commands. OpenGL runs them at once.
  virtual void drop(const std::function<void(void*, uint64_t)>& record) = 0;

  // Waits, then reads the numbers of a layer of an output, with rows in memory order.
  virtual std::vector<float> read(const grisaille_host_output& output, uint32_t layer = 0) = 0;

  // Number of messages from the API's own validation.
  virtual int complaints() const = 0;
};

// Makes a host on this device. `validate`: off for tests that count allocations, since validation
// layers allocate themselves.
std::unique_ptr<Host> makeHost(const TestDevice& device, bool validate = true);

}  // namespace grisaille::tests

// Runs a suite in a host on every installed device. Hosts are created before a suite could be
// skipped, so HostDevices.AreInstalled reports missing devices as skipped.
#define GRISAILLE_IN_EVERY_HOST(Suite)                                                           \
  INSTANTIATE_TEST_SUITE_P(, Suite, ::testing::ValuesIn(::grisaille::tests::installedDevices()), \
                           GRISAILLE_DEVICE_NAME)
