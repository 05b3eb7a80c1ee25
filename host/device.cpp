// SPDX-License-Identifier: MIT
#include "host/device.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>

#include "core/gpu/checking_device.h"
#include "host/checks.h"

namespace grisaille::host {
namespace {

namespace fs = std::filesystem;

// grisaille/effects beside the library's file; "" if the loader does not report that file.
fs::path ownEffects() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(grisaille_host_version), &info) == 0) return {};
  std::error_code failed;
  const fs::path file = fs::canonical(info.dli_fname, failed);
  return failed ? fs::path() : file.parent_path() / "grisaille" / "effects";
}

bool isHit(const grisaille_hit& hit) {
  if (hit.kind == GRISAILLE_HIT_NONE || hit.kind == GRISAILLE_HIT_UNKNOWN) return true;
  const glm::vec3 normal(hit.normal[0], hit.normal[1], hit.normal[2]);
  return hit.kind == GRISAILLE_HIT_SURFACE && hit.distance >= 0 && std::isfinite(hit.distance) &&
         std::abs(glm::length(normal) - 1) < 1e-3f;
}

}  // namespace

void Rays::cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) {
  std::ranges::fill(hits, grisaille_hit{});
  rays_.cast(rays_.context, rays.data(), rays.size(), hits.data());
  const auto wrong = std::ranges::find_if_not(hits, isHit);
  if (wrong == hits.end()) return;
  throw Error(ErrorId::kHostValue,
              "hit {} of {} from the host's function has the kind {}, the distance {} and the "
              "normal {}, {}, {}",
              wrong - hits.begin(), hits.size(), wrong->kind, wrong->distance, wrong->normal[0],
              wrong->normal[1], wrong->normal[2]);
}

void Depths::draw(const grisaille_depth_view& view, std::span<float> depth) {
  std::ranges::fill(depth, std::numeric_limits<float>::quiet_NaN());
  depths_.draw(depths_.context, &view, depth.data());
  const auto wrong = std::ranges::find_if(depth, [](float metres) { return metres <= 0; });
  if (wrong == depth.end()) return;
  throw Error(ErrorId::kHostValue, "depth {} of {} from the host's function is {}, not over 0",
              wrong - depth.begin(), depth.size(), *wrong);
}

void Pictures::read(const char* path, grisaille_picture& out) {
  grisaille_picture picture = {};
  picture.struct_size = sizeof(picture);
  if (pictures_.read(pictures_.context, path, &picture) != GRISAILLE_OK) {
    throw Error(ErrorId::kHostValue, "the host's function cannot read the picture {}",
                oneLine(path));
  }
  if (picture.width == 0 || picture.height == 0 || picture.rgba == nullptr) {
    throw Error(ErrorId::kHostValue, "the host's picture {} has {} x {} pixels{}", oneLine(path),
                picture.width, picture.height, picture.rgba == nullptr ? ", and rgba is null" : "");
  }
  out = picture;
}

}  // namespace grisaille::host

namespace {

std::unique_ptr<grisaille::gpu::HostDevice> checkedIf(
    bool checks, std::unique_ptr<grisaille::gpu::HostDevice> device,
    const grisaille::host::Log& log) {
  if (!checks) return device;
  return grisaille::gpu::makeCheckingHostDevice(std::move(device), log.sink());
}

}  // namespace

grisaille_host_device::grisaille_host_device(std::unique_ptr<grisaille::gpu::HostDevice> made,
                                             Spec spec)
    : log(spec.log),
      framesInFlight(spec.framesInFlight),
      memory(std::move(spec.memory)),
      gpu(checkedIf((spec.flags & GRISAILLE_HOST_CHECK) != 0, std::move(made), log)),
      kernels(*gpu),
      pipelines(*gpu, log) {
  const auto own = grisaille::host::ownEffects();
  std::error_code failed;
  if (std::filesystem::is_directory(own, failed)) registry.scan(own);
  if (spec.effectFolder != nullptr) registry.scan(spec.effectFolder);
  for (const grisaille::effect::Refused& refused : registry.refused()) {
    log.write(GRISAILLE_HOST_WARNING, refused.reason.what());
  }
  for (const grisaille::effect::Effect& effect : registry.effects()) {
    tables.push_back(effect.desc);
  }
}

grisaille_host_texture::grisaille_host_texture(grisaille_host_device& of,
                                               const grisaille_host_texture_desc& desc)
    : device(of) {
  device.gpu->requireUsable();
  grisaille::host::checkReserved(desc.reserved, "desc.reserved");
  constexpr uint32_t kMostLayers = 16;
  if (desc.layers > kMostLayers) {
    throw grisaille::Error(grisaille::ErrorId::kHostValue, "desc.layers is {}, over {}",
                           desc.layers, kMostLayers);
  }
  texture = device.gpu->wrap({.name = desc.image,
                              .format = desc.format,
                              .layout = desc.layout,
                              .width = desc.width,
                              .height = desc.height,
                              .firstLayer = desc.first_layer,
                              .layers = std::max(desc.layers, 1u)});
  info = device.gpu->foreign(texture);
  ++device.textures;
}

grisaille_host_texture::~grisaille_host_texture() {
  device.gpu->destroy(texture);
  --device.textures;
}
