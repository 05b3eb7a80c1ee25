// SPDX-License-Identifier: MIT
#include "app/services/scene_services.h"

#include <chrono>

#include "core/base/regular_file.h"
#include "core/trace/background.h"

namespace grisaille::app {

void printWarning(const std::string& /*path*/, const std::string& text) {
  if (!text.empty()) fmt::print(stderr, "warning: {}\n", text);
}

SceneRays::Tracer SceneRays::build() const {
  return std::make_unique<trace::RayTracer>(scene_, (scene_.bounds.min + scene_.bounds.max) / 2.0);
}

void SceneRays::prepare() {
  if (tracer_ || building_.valid() || failed_) return;
  building_ = std::async(std::launch::async, [this] {
    Tracer built;
    trace::leavingACore([&] { built = build(); });
    return built;
  });
}

bool SceneRays::isReady() {
  if (building_.valid() &&
      building_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    try {
      tracer_ = building_.get();
    } catch (const Error&) {
      failed_ = true;
    }
  }
  return tracer_ != nullptr;
}

trace::RayTracer& SceneRays::ready() {
  wait();
  if (!isReady()) tracer_ = build();
  tracer_->follow();
  return *tracer_;
}

void SceneRays::cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) {
  ready().castRays(rays, hits);
}

trace::SurfacePoints SceneRays::surface(const trace::SurfaceSpec& spec) {
  return ready().surfacePoints(spec);
}

void PictureFiles::read(const char* path, grisaille_picture& out) {
  try {
    const std::string bytes = readRegularFile(path, ErrorId::kImageUnreadable);
    picture_ = image::decode(std::as_bytes(std::span(bytes)), oneLine(path));
  } catch (const Error& error) {
    if (warned_.insert(path).second) warn_(path, error.detail());
    throw;
  }
  if (warned_.erase(path) > 0) warn_(path, "");
  out.width = picture_.width;
  out.height = picture_.height;
  out.reserved = 0;
  out.rgba = picture_.pixels.data();
}

}  // namespace grisaille::app
