// SPDX-License-Identifier: MIT
#include "tests/bench/painted.h"

#include <chrono>

namespace grisaille::bench {

Painted::Painted(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
                 tests::TracedRays& rays, std::span<const std::string> effects)
    : device_(device),
      subject_(subject),
      rays_(rays),
      chain_(effect::Selection(registry, effects)),
      started_(chain_, device),
      renderer_(device, subject.scene) {}

void Painted::add(std::span<const lab::Shot> shots) {
  objects::ObjectList& list = *chain_.objects("sspm");
  list.add(objectsOf(list.table(), shots).view());
}

double Painted::render(const View& view) {
  const auto start = std::chrono::steady_clock::now();
  renderer_.render({.camera = view.camera,
                    .width = view.width,
                    .height = view.height,
                    .chain = &chain_,
                    .outputs = outputs_,
                    .patience = view.patience,
                    .services = {.rays = &rays_}});
  device_.wait();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
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
