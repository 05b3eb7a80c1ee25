// SPDX-License-Identifier: MIT
#include "tests/effects/sspm/paint_frame.h"

#include <array>

namespace grisaille::tests {
namespace {

effect::Selection selected(effect::Registry& registry) {
  registry.scan(EFFECTS_FOLDER);
  return effect::Selection(registry, std::array<std::string, 1>{"sspm"});
}

}  // namespace

PaintFrame::PaintFrame(gpu::Device& device, const scene::Scene& scene)
    : chain_(selected(registry_)), started_(chain_, device), renderer_(device, scene) {}

PaintFrame::PaintFrame(gpu::Device& device, frame::AttachmentSource& source)
    : chain_(selected(registry_)), started_(chain_, device), renderer_(device, source) {}

void PaintFrame::set(const Settings& settings) {
  chain_.selection = effect::Selection(registry_, std::array<std::string, 1>{"sspm"});
  for (const auto& [key, value] : settings) chain_.selection.values("sspm").set(key, value);
}

void PaintFrame::assign(std::span<const lab::Shot> shots) {
  objects::ObjectList& list = *chain_.objects("sspm");
  list.assign(objectsOf(list.table(), shots).view());
}

void PaintFrame::render(const scene::Camera& camera, uint32_t width, uint32_t height,
                        std::span<const lab::Shot> shots, std::vector<std::string> outputs) {
  assign(shots);
  renderer_.render({.camera = camera,
                    .width = width,
                    .height = height,
                    .chain = &chain_,
                    .outputs = outputs,
                    .patience = patience_,
                    .services = {.rays = rays_, .depths = depths_}});
}

std::vector<grisaille_drawn> PaintFrame::drawAt(std::span<const grisaille_point> points) {
  std::vector<grisaille_drawn> drawn(points.size());
  chain_.drawAt(chain_.selection.entries()[0], {.points = points, .drawn = drawn, .rays = rays_});
  return drawn;
}

frame::Pictures tracedPictures(const trace::RayTracer& tracer, const scene::Camera& camera,
                               uint32_t width, uint32_t height) {
  return {.viewDepth = trace::depthImage(tracer.castPrimary(camera, width, height), width, height),
          .normal = {},
          .baseColour = {}};
}

lab::Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
                 float range) {
  const glm::vec3 direction(glm::normalize(target - origin));
  return {.origin = {origin.x, origin.y, origin.z},
          .direction = {direction.x, direction.y, direction.z},
          .color = {color.x, color.y, color.z},
          .range = range};
}

glm::vec3 randomColor(std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  return {unit(random), unit(random), unit(random)};
}

}  // namespace grisaille::tests
