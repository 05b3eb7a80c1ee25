// SPDX-License-Identifier: MIT
#include "host/device.h"

#include <dlfcn.h>

#include <filesystem>

#include "host/checks.h"

namespace grisaille::host {
namespace {

namespace fs = std::filesystem;

// lib/grisaille/effects of the library's own folder; "" where the loader does not tell it.
fs::path ownEffects() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(grisaille_host_version), &info) == 0) return {};
  std::error_code failed;
  const fs::path file = fs::canonical(info.dli_fname, failed);
  return failed ? fs::path() : file.parent_path() / "grisaille" / "effects";
}

}  // namespace
}  // namespace grisaille::host

grisaille_host_device::grisaille_host_device(std::unique_ptr<grisaille::gpu::HostDevice> made,
                                             const char* effectFolder)
    : gpu(std::move(made)), kernels(*gpu) {
  const auto own = grisaille::host::ownEffects();
  std::error_code failed;
  if (std::filesystem::is_directory(own, failed)) registry.scan(own);
  if (effectFolder != nullptr) registry.scan(effectFolder);
  for (const grisaille::effect::Effect& effect : registry.effects()) {
    tables.push_back(effect.desc);
  }
}

grisaille_host_texture::grisaille_host_texture(grisaille_host_device& of,
                                               const grisaille_host_texture_desc& desc)
    : device(of) {
  device.gpu->requireUsable();
  grisaille::host::checkReserved(desc.reserved, "desc.reserved");
  texture = device.gpu->wrap({.name = desc.image,
                              .format = desc.format,
                              .layout = desc.layout,
                              .width = desc.width,
                              .height = desc.height});
  info = device.gpu->foreign(texture);
  ++device.textures;
}

grisaille_host_texture::~grisaille_host_texture() {
  device.gpu->destroy(texture);
  --device.textures;
}
