// SPDX-License-Identifier: MIT
// Hosts of the library for tests: a Vulkan device or an OpenGL context of their own, textures of
// numbers, frames that are waited for.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grisaille/host.hpp"
#include "tests/support/test_device.h"

namespace grisaille::tests {

enum class Texels : uint8_t { kFloat1, kFloat4, kUnorm8x4, kDepth24 };

class Host {
 public:
  virtual ~Host() = default;

  // `effectFolder`: of further effects; null: none.
  virtual host::Device device(const char* effectFolder = nullptr) = 0;

  // A texture of the host's, wrapped: numbers of so many channels as the texels have, rows in
  // memory as they come. It lives as long as the host.
  virtual host::Texture texture(const host::Device& device, Texels texels, uint32_t width,
                                uint32_t height, const std::vector<float>& numbers) = 0;
  // How it describes the last one.
  virtual host::TextureSpec described() const = 0;

  // Runs a frame: `record` gets the command buffer and the frame's number. `after` runs when it is
  // recorded, before it is submitted.
  virtual void frame(const std::function<void(void*, uint64_t)>& record) = 0;

  // The numbers of an output, rows as they are in memory. Waits.
  virtual std::vector<float> read(const grisaille_host_output& output) = 0;

  // What the API's own validation has complained of.
  virtual int complaints() const = 0;
};

// A host on this device. Validation layers allocate themselves.
std::unique_ptr<Host> makeHost(const TestDevice& device, bool validate = true);

}  // namespace grisaille::tests

// Runs a suite in a host of every device that is installed: hosts are made before a suite can be
// skipped. HostDevices.AreInstalled is skipped where one is missing.
#define GRISAILLE_IN_EVERY_HOST(Suite)                                                           \
  INSTANTIATE_TEST_SUITE_P(, Suite, ::testing::ValuesIn(::grisaille::tests::installedDevices()), \
                           GRISAILLE_DEVICE_NAME)
