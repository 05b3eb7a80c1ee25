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
