// SPDX-License-Identifier: MIT
// Services of the program for effects: ray casts through the scene, and decoded picture files; and
// the scene's matter, which all renderers of the scene share.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/effect/instance.h"
#include "core/image/image.h"
#include "core/trace/ray_tracer.h"
#include "core/trace/scene_matter.h"

namespace grisaille::app {

// Casts rays with Embree. The first cast() builds Embree's scene, unless prepare() has.
class SceneRays : public effect::RayService {
 public:
  // `scene` must outlive this and change only by scene::pose(), between two casts. Call wait()
  // before scene::pose().
  explicit SceneRays(const scene::Scene& scene) : scene_(scene) {}

  // Starts building Embree's scene on a thread of its own, at the first call. Never throws.
  void prepare();
  // False while it is being built, and if that failed: a cast() then throws.
  bool isReady();
  // Waits until it is built.
  void wait() {
    if (building_.valid()) building_.wait();
  }

  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override;
  // Points of the scene's surface in its current pose.
  trace::SurfacePoints surface(const trace::SurfaceSpec& spec);

 private:
  using Tracer = std::unique_ptr<trace::RayTracer>;

  // The tracer, built if necessary, with the scene's current pose.
  trace::RayTracer& ready();

  Tracer build() const;

  const scene::Scene& scene_;
  Tracer tracer_;
  bool failed_ = false;
  std::future<Tracer> building_;  // last: its thread reads the members above
};

// Receives a warning about a file; an empty text: the file that it was about can be read now.
// printWarning() prints the text to standard error.
using Warn = std::function<void(const std::string& path, const std::string& text)>;
void printWarning(const std::string& path, const std::string& text);

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
      : rays_(scene), matter_(scene), pictures_(std::move(warn)) {}

  effect::Services all() { return {.rays = &rays_, .pictures = &pictures_}; }
  SceneRays& rays() { return rays_; }
  trace::SceneMatter& matter() { return matter_; }

 private:
  SceneRays rays_;
  trace::SceneMatter matter_;
  PictureFiles pictures_;
};

}  // namespace grisaille::app
