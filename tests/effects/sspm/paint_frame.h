// SPDX-License-Identifier: MIT
// Renders pictures of paint for tests: one scene, one device, any shots and settings.
#pragma once

#include <limits>
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

// The size of a small picture, and a camera in front of the corner between floor and wall.
constexpr uint32_t kWidth = 96;
constexpr uint32_t kHeight = 72;
inline const scene::Camera kCrease = {.eye = glm::dvec3(0.3, 1.5, 2.5),
                                      .target = glm::dvec3(0, 0.5, 0)};

class PaintFrame {
 public:
  PaintFrame(gpu::Device& device, const scene::Scene& scene);
  // Renders from another source's attachments. `source` must outlive this object.
  PaintFrame(gpu::Device& device, frame::AttachmentSource& source);

  // nullptr: this host casts no rays.
  void setRays(effect::RayService* rays) { rays_ = rays; }
  // nullptr, the initial value: this host draws no depth pictures.
  void setDepths(effect::DepthService* depths) { depths_ = depths; }
  void set(const Settings& settings);
  // Seconds a frame for placing shots. Without limit at first.
  void setPatience(double seconds) { patience_ = seconds; }

  // Replaces the list of shots without a frame.
  void assign(std::span<const lab::Shot> shots);
  // The effect is told how many leading shots equal those of the previous call.
  void render(const scene::Camera& camera, uint32_t width, uint32_t height,
              std::span<const lab::Shot> shots,
              std::vector<std::string> outputs = {"paint", "paint_coverage", "depth"});
  image::Image read(const std::string& output) { return renderer_.read(output); }
  // What the shots of the last render() draw at points of surfaces.
  std::vector<grisaille_drawn> drawAt(std::span<const grisaille_point> points);
  uint64_t waiting() const { return renderer_.report().waiting; }
  uint64_t givenUp() const { return renderer_.report().givenUp; }
  uint64_t coarser() const { return renderer_.report().coarser; }

 private:
  effect::Registry registry_;
  effect::Chain chain_;
  effect::StartedChain started_;
  frame::Renderer renderer_;
  double patience_ = std::numeric_limits<double>::infinity();
  effect::RayService* rays_ = nullptr;
  effect::DepthService* depths_ = nullptr;
};

// Depth from ray casts, which is exact on every rasteriser.
frame::Pictures tracedPictures(const trace::RayTracer& tracer, const scene::Camera& camera,
                               uint32_t width, uint32_t height);

// A shot from `origin` towards `target`.
lab::Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
                 float range = 0);

glm::vec3 randomColor(std::mt19937& random);

}  // namespace grisaille::tests
