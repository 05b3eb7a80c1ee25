// SPDX-License-Identifier: MIT
// Stands in for backends/backends.cpp where one backend alone is linked (GRISAILLE_TEST_ONLY).
#include "backends/backends.h"
#include "backends/opengl/opengl.h"
#include "backends/vulkan/vulkan.h"
#include "core/gpu/checking_device.h"

namespace grisaille::backends {
namespace {

constexpr Backend kBackends[] = {{ONLY_NAME, ONLY::listDevices, ONLY::createDevice}};

}  // namespace

std::span<const Backend> all() {
  return kBackends;
}

std::unique_ptr<gpu::Device> create(std::string_view, const gpu::DeviceOptions& options) {
  return gpu::makeCheckingDevice(kBackends[0].create(options), options.message);
}

}  // namespace grisaille::backends
