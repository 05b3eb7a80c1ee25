// SPDX-License-Identifier: MIT
#include "backends/backends.h"

#include "backends/opengl/opengl.h"
#include "backends/vulkan/vulkan.h"
#include "core/base/error.h"
#include "core/gpu/checking_device.h"

namespace grisaille::backends {
namespace {

constexpr Backend kBackends[] = {{"opengl", "OpenGL", opengl::listDevices, opengl::createDevice},
                                 {"vulkan", "Vulkan", vulkan::listDevices, vulkan::createDevice}};

#ifdef NDEBUG
constexpr bool kAlwaysCheck = false;
#else
constexpr bool kAlwaysCheck = true;
#endif

}  // namespace

std::span<const Backend> all() {
  return kBackends;
}

const Backend& find(std::string_view name) {
  for (const Backend& backend : kBackends) {
    if (backend.name == name) return backend;
  }
  throw Error(ErrorId::kBackendUnknown, "there is no backend '{}'", name);
}

std::unique_ptr<gpu::Device> create(std::string_view name, const gpu::DeviceOptions& options) {
  std::unique_ptr<gpu::Device> device = find(name).create(options);
  if (!options.check && !kAlwaysCheck) return device;
  return gpu::makeCheckingDevice(std::move(device), options.message);
}

}  // namespace grisaille::backends
