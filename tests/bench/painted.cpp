// SPDX-License-Identifier: MIT
#include "tests/bench/painted.h"

namespace grisaille::bench {

Painted::Painted(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
                 effect::RayService& rays, std::span<const std::string> effects)
    : device_(device),
      subject_(subject),
      rays_(rays),
      chain_(effect::Selection(registry, effects)),
      started_(chain_, device),
      renderer_(device, subject.scene) {}

Painted::Painted(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
                 effect::RayService& rays, std::span<const std::string> effects,
                 frame::AttachmentSource& source)
    : device_(device),
      subject_(subject),
      rays_(rays),
      chain_(effect::Selection(registry, effects)),
      started_(chain_, device),
      renderer_(device, source) {}

void Painted::add(std::span<const lab::Shot> shots) {
  objects::ObjectList& list = this->shots();
  list.add(objectsOf(list.table(), shots).view());
}

double Painted::render(const View& view) {
  const auto start = Clock::now();
  renderer_.render({.camera = view.camera,
                    .width = view.width,
                    .height = view.height,
                    .chain = &chain_,
                    .outputs = outputs_,
                    .patience = view.patience,
                    .services = {.rays = &rays_}});
  device_.wait();
  return 1000 * secondsSince(start);
}

double Painted::settle(double patience) {
  double took = 0;
  do {
    took +=
        render({.camera = subject_.cameras[0], .width = 64, .height = 36, .patience = patience});
  } while (report().waiting > 0);
  return took;
}

}  // namespace grisaille::bench
