// SPDX-License-Identifier: MIT
// Services of the program for effects: ray casts through the scene, and decoded picture files.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/effect/instance.h"
#include "core/image/image.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app {

// Casts rays with Embree. The first cast() builds Embree's scene.
class SceneRays : public effect::RayService {
 public:
  // `scene` must outlive this and change only by scene::pose(), between two casts.
  explicit SceneRays(const scene::Scene& scene) : scene_(scene) {}

  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    if (!tracer_) tracer_.emplace(scene_, (scene_.bounds.min + scene_.bounds.max) / 2.0);
    tracer_->follow();
    tracer_->castRays(rays, hits);
  }

 private:
  const scene::Scene& scene_;
  std::optional<trace::RayTracer> tracer_;
};

// Receives a warning. printWarning() prints it to standard error.
using Warn = std::function<void(const std::string&)>;
void printWarning(const std::string& text);

// Reads any format of OpenImageIO, up to 16384 pixels a side. A file that cannot be read causes one
// warning; every later call tries to read it again.
class PictureFiles : public effect::PictureService {
 public:
  explicit PictureFiles(Warn warn) : warn_(std::move(warn)) {}
  void read(const char* path, grisaille_picture& out) override;

 private:
  Warn warn_;
  image::Image8 picture_;         // the last picture read
  std::set<std::string> warned_;  // paths with a warning
};

class SceneServices {
 public:
  explicit SceneServices(const scene::Scene& scene, Warn warn = printWarning)
      : rays_(scene), pictures_(std::move(warn)) {}

  effect::Services all() { return {.rays = &rays_, .pictures = &pictures_}; }
  effect::RayService& rays() { return rays_; }

 private:
  SceneRays rays_;
  PictureFiles pictures_;
};

}  // namespace grisaille::app
