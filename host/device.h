// SPDX-License-Identifier: MIT
// What grisaille_host_device and grisaille_host_texture point to.
#pragma once

#include <memory>
#include <vector>

#include "core/effect/registry.h"
#include "core/gpu/host_device.h"
#include "grisaille/host.h"
#include "host/attachments.h"

struct grisaille_host_device {
  // The effects beside the library, and those of a further folder, which may be null. Throws
  // kPluginPath.
  grisaille_host_device(std::unique_ptr<grisaille::gpu::HostDevice> made, const char* effectFolder);

  grisaille::effect::Registry registry;
  std::vector<const grisaille_effect_desc*> tables;  // of its effects
  std::unique_ptr<grisaille::gpu::HostDevice> gpu;
  grisaille::host::Kernels kernels;
  uint32_t textures = 0, effects = 0;  // that live
};

struct grisaille_host_texture {
  grisaille_host_texture(grisaille_host_device& of, const grisaille_host_texture_desc& desc);
  ~grisaille_host_texture();
  grisaille_host_texture(const grisaille_host_texture&) = delete;
  grisaille_host_texture& operator=(const grisaille_host_texture&) = delete;

  grisaille_host_device& device;
  grisaille::gpu::Texture texture;
  grisaille::gpu::ForeignInfo info;
};
