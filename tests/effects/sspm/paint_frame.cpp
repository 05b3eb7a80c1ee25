// SPDX-License-Identifier: MIT
#include "tests/effects/sspm/paint_frame.h"

#include <array>

namespace grisaille::tests {
namespace {

effect::Registry& scanned(effect::Registry& registry) {
  registry.scan(EFFECTS_FOLDER);
  return registry;
}

}  // namespace

PaintFrame::PaintFrame(gpu::Device& device, const scene::Scene& scene)
    : values_(scanned(registry_).find("sspm")),
      instance_(device, registry_.find("sspm")),
      renderer_(device, scene) {}

PaintFrame::PaintFrame(gpu::Device& device, frame::AttachmentSource& source)
    : values_(scanned(registry_).find("sspm")),
      instance_(device, registry_.find("sspm")),
      renderer_(device, source) {}

void PaintFrame::set(const Settings& settings) {
  values_ = effect::Values(registry_.find("sspm"));
  for (const auto& [key, value] : settings) values_.set(key, value);
}

void PaintFrame::render(const scene::Camera& camera, uint32_t width, uint32_t height,
                        std::span<const grisaille_shot> shots, size_t kept,
                        std::vector<std::string> outputs) {
  const std::array effects = {frame::ActiveEffect{
      .instance = &instance_, .values = &values_, .shots = shots, .shotsKept = kept}};
  renderer_.render({.camera = camera,
                    .width = width,
                    .height = height,
                    .effects = effects,
                    .outputs = outputs,
                    .rays = rays_});
}

frame::Pictures tracedPictures(const trace::RayTracer& tracer, const scene::Camera& camera,
                               uint32_t width, uint32_t height) {
  return {.viewDepth = trace::depthImage(tracer.castPrimary(camera, width, height), width, height),
          .normal = {},
          .baseColour = {}};
}

grisaille_shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
                      float range) {
  const glm::vec3 direction(glm::normalize(target - origin));
  return {.origin = {origin.x, origin.y, origin.z},
          .direction = {direction.x, direction.y, direction.z},
          .color = {color.x, color.y, color.z},
          .range = range,
          .reserved = 0};
}

glm::vec3 randomColor(std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  return {unit(random), unit(random), unit(random)};
}

}  // namespace grisaille::tests
