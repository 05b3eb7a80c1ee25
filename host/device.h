// SPDX-License-Identifier: MIT
// What grisaille_host_device and grisaille_host_texture point to.
#pragma once

#include <memory>
#include <vector>

#include "core/effect/instance.h"
#include "core/effect/registry.h"
#include "core/gpu/host_device.h"
#include "grisaille/host.h"
#include "host/attachments.h"

namespace grisaille::host {

// What the host casts.
class Rays : public effect::RayService {
 public:
  void set(const grisaille_host_rays& rays) { rays_ = rays; }
  explicit operator bool() const { return rays_.cast != nullptr; }

  // Throws kHostValue where a hit is none.
  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override;

 private:
  grisaille_host_rays rays_ = {};
};

// What the host decodes.
class Pictures : public effect::PictureService {
 public:
  void set(const grisaille_host_pictures& pictures) { pictures_ = pictures; }
  explicit operator bool() const { return pictures_.read != nullptr; }

  // Throws kHostValue where the host reads none, or what it says is no picture.
  void read(const char* path, grisaille_picture& out) override;

 private:
  grisaille_host_pictures pictures_ = {};
};

}  // namespace grisaille::host

struct grisaille_host_device {
  // The effects beside the library, and those of a further folder, which may be null. Throws
  // kPluginPath.
  grisaille_host_device(std::unique_ptr<grisaille::gpu::HostDevice> made, const char* effectFolder);

  grisaille::effect::Registry registry;
  std::vector<const grisaille_effect_desc*> tables;  // of its effects
  std::unique_ptr<grisaille::gpu::HostDevice> gpu;
  grisaille::host::Kernels kernels;
  uint32_t textures = 0, effects = 0;  // that live
  grisaille::host::Rays rays;
  grisaille::host::Pictures pictures;
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
