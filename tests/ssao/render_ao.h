// SPDX-License-Identifier: MIT
// Pictures of the effect's output, for its tests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/frame/renderer.h"

namespace grisaille::tests {

using Settings = std::vector<std::pair<std::string, std::string>>;

constexpr uint32_t kAoWidth = 96;
constexpr uint32_t kAoHeight = 72;

inline image::Image renderAo(gpu::Device& device, const scene::Scene& scene,
                             const scene::Camera& camera, const Settings& settings,
                             uint32_t width = kAoWidth, uint32_t height = kAoHeight) {
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  effect::Values values(registry.find("ssao"));
  for (const auto& [key, value] : settings) values.set(key, value);
  effect::Instance instance(device, registry.find("ssao"));
  frame::Renderer renderer(device, scene);
  const std::array effects = {frame::ActiveEffect{.instance = &instance, .values = &values}};
  const std::vector<std::string> outputs = {"ao"};
  renderer.render(
      {.camera = camera, .width = width, .height = height, .effects = effects, .outputs = outputs});
  return renderer.read("ao");
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
