// SPDX-License-Identifier: MIT
// Renders the effect's output for its tests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/effect/chain.h"
#include "core/frame/renderer.h"

namespace grisaille::tests {

using Settings = std::vector<std::pair<std::string, std::string>>;

constexpr uint32_t kAoWidth = 96;
constexpr uint32_t kAoHeight = 72;

// The effect with one instance, for several frames.
class AoFrames {
 public:
  AoFrames(gpu::Device& device, const scene::Scene& scene, const Settings& settings)
      : registry_(scanned()),
        chain_(effect::Selection(*registry_, std::array<std::string, 1>{"ssao"})),
        started_(chain_, device),
        renderer_(device, scene) {
    set(settings);
  }

  void set(const Settings& settings) {
    for (const auto& [key, value] : settings) chain_.selection.values("ssao").set(key, value);
  }

  image::Image show(const scene::Camera& camera, uint32_t width = kAoWidth,
                    uint32_t height = kAoHeight) {
    return showAll(camera, width, height, {"ao"}).front();
  }

  // Renders one frame; returns its outputs.
  std::vector<image::Image> showAll(const scene::Camera& camera, uint32_t width, uint32_t height,
                                    const std::vector<std::string>& outputs,
                                    frame::Surface surface = frame::Surface::kWhite) {
    renderer_.render({.camera = camera,
                      .width = width,
                      .height = height,
                      .surface = surface,
                      .chain = &chain_,
                      .outputs = outputs});
    std::vector<image::Image> images;
    for (const std::string& output : outputs) images.push_back(renderer_.read(output));
    return images;
  }

 private:
  static std::unique_ptr<effect::Registry> scanned() {
    auto registry = std::make_unique<effect::Registry>();
    registry->scan(EFFECTS_FOLDER);
    return registry;
  }

  std::unique_ptr<effect::Registry> registry_;
  effect::Chain chain_;
  effect::StartedChain started_;
  frame::Renderer renderer_;
};

inline image::Image renderAo(gpu::Device& device, const scene::Scene& scene,
                             const scene::Camera& camera, const Settings& settings,
                             uint32_t width = kAoWidth, uint32_t height = kAoHeight) {
  return AoFrames(device, scene, settings).show(camera, width, height);
}

// World position of the surface at a pixel of a picture. `depth`: the output of that name.
inline glm::dvec3 surfaceAt(const scene::Camera& camera, const image::Image& depth, uint32_t x,
                            uint32_t y) {
  const double slope = std::tan(glm::radians(camera.fovyDegrees) / 2) * 2 / depth.height;
  const glm::dvec3 ray((x + 0.5 - depth.width / 2.0) * slope,
                       (depth.height / 2.0 - y - 0.5) * slope, -1);
  return camera.eye + scene::worldFromView(camera) * ray * double{depth.at(x, y)};
}

// Share of the cosine-weighted directions about a unit normal that hit nothing. hits(direction).
template <typename Hits>
double tracedVisibility(const glm::dvec3& normal, int rays, Hits&& hits) {
  const glm::dvec3 along = glm::normalize(
      glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 across = glm::cross(normal, along);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    const double u = (i + 0.5) / rays, phi = i * 2.399963;  // a spiral
    open += hits(std::sqrt(u) * (std::cos(phi) * along + std::sin(phi) * across) +
                 std::sqrt(1 - u) * normal)
                ? 0
                : 1;
  }
  return static_cast<double>(open) / rays;
}

inline double meanRows(const image::Image& image, uint32_t fromRow, uint32_t toRow) {
  double sum = 0;
  for (uint32_t y = fromRow; y < toRow; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) sum += image.at(x, y);
  }
  return sum / (image.width * (toRow - fromRow));
}

inline void expectVisibility(const image::Image& image, const std::string& what) {
  for (const float value : image.pixels) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 1) << value << " with " << what;
  }
}

}  // namespace grisaille::tests
