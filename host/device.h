// SPDX-License-Identifier: MIT
// The objects behind grisaille_host_device and grisaille_host_texture.
#pragma once

#include <memory>
#include <vector>

#include "backends/vulkan/vulkan.h"
#include "core/effect/instance.h"
#include "core/effect/registry.h"
#include "core/gpu/host_device.h"
#include "grisaille/host.h"
#include "host/attachments.h"
#include "host/log.h"
#include "host/pipelines.h"

namespace grisaille::host {

// Ray casts by the host's function.
class Rays : public effect::RayService {
 public:
  void set(const grisaille_host_rays& rays) { rays_ = rays; }
  explicit operator bool() const { return rays_.cast != nullptr; }

  // Throws kHostValue if a hit is invalid.
  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override;

 private:
  grisaille_host_rays rays_ = {};
};

// Depth pictures by the host's function.
class Depths : public effect::DepthService {
 public:
  void set(const grisaille_host_depths& depths) { depths_ = depths; }
  explicit operator bool() const { return depths_.draw != nullptr; }

  // Throws kHostValue if a depth is invalid.
  void draw(const grisaille_depth_view& view, std::span<float> depth) override;

 private:
  grisaille_host_depths depths_ = {};
};

// Pictures that the host's function decodes.
class Pictures : public effect::PictureService {
 public:
  void set(const grisaille_host_pictures& pictures) { pictures_ = pictures; }
  explicit operator bool() const { return pictures_.read != nullptr; }

  // Throws kHostValue if the host's function fails or returns an invalid picture.
  void read(const char* path, grisaille_picture& out) override;

 private:
  grisaille_host_pictures pictures_ = {};
};

}  // namespace grisaille::host

struct grisaille_host_device {
  // Properties that both APIs have.
  struct Spec {
    const char* effectFolder = nullptr;  // may be null
    uint32_t framesInFlight = 1;
    uint32_t flags = 0;  // grisaille_host_flags
    grisaille::host::Log log;
    std::unique_ptr<grisaille::vulkan::MemorySource> memory = nullptr;  // null: the driver's
  };

  // Loads the effects installed with the library and the effects in the folder. Throws kPluginPath.
  grisaille_host_device(std::unique_ptr<grisaille::gpu::HostDevice> made, Spec spec);

  const grisaille::host::Log log;
  const uint32_t framesInFlight;
  const std::unique_ptr<grisaille::vulkan::MemorySource> memory;  // of `gpu`
  grisaille::effect::Registry registry;
  std::vector<const grisaille_effect_desc*> tables;  // of the registry's effects
  std::unique_ptr<grisaille::gpu::HostDevice> gpu;
  grisaille::host::Kernels kernels;
  grisaille::host::Pipelines pipelines;  // makes the resources of effects
  uint32_t textures = 0, effects = 0;    // numbers of live objects
  grisaille::host::Rays rays;
  grisaille::host::Depths depths;
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
