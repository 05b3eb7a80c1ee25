// SPDX-License-Identifier: MIT
// Pictures of paint for tests: one scene, one device, any shots and settings.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/effect/chain.h"
#include "core/frame/picture_attachments.h"
#include "core/frame/renderer.h"
#include "lab/paint/shot.h"
#include "tests/support/traced_rays.h"

namespace grisaille::tests {

using Settings = std::vector<std::pair<std::string, std::string>>;

// The size of a small picture, and a camera before the corner that floor and wall make.
constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 72;
inline const scene::Camera kCrease = {.eye = glm::dvec3(0.3, 1.5, 2.5),
                                      .target = glm::dvec3(0, 0.5, 0)};

class PaintFrame {
 public:
  PaintFrame(gpu::Device& device, const scene::Scene& scene);
  // Of attachments from elsewhere. `source` outlives this.
  PaintFrame(gpu::Device& device, frame::AttachmentSource& source);

  // nullptr: this host casts none.
  void setRays(effect::RayService* rays) { rays_ = rays; }
  void set(const Settings& settings);

  // What the shots have in common with those of the call before, the effect is told to keep.
  void render(const scene::Camera& camera, uint32_t width, uint32_t height,
              std::span<const lab::Shot> shots,
              std::vector<std::string> outputs = {"paint", "paint_coverage", "depth"});
  image::Image read(const std::string& output) { return renderer_.read(output); }
  uint64_t waiting() const { return renderer_.waiting(); }

 private:
  effect::Registry registry_;
  effect::Chain chain_;
  effect::StartedChain started_;
  frame::Renderer renderer_;
  effect::RayService* rays_ = nullptr;
};

// The depth that rays find, which no rasteriser's snapping moves off the surfaces.
frame::Pictures tracedPictures(const trace::RayTracer& tracer, const scene::Camera& camera,
                               uint32_t width, uint32_t height);

// A shot from `origin` at `target`.
lab::Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
                 float range = 0);

glm::vec3 randomColor(std::mt19937& random);

}  // namespace grisaille::tests
