// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_score.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/effect/chain.h"
#include "core/frame/renderer.h"
#include "core/gpu/null_device.h"
#include "core/trace/parallel.h"
#include "lab/oracle/paint.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

constexpr uint32_t kPoints = 100'000, kReferencePoints = 20'000;

trace::SurfacePoints sample(const trace::RayTracer& tracer, uint32_t count, uint32_t seed) {
  return tracer.surfacePoints({.count = count, .steepest = std::numbers::pi, .seed = seed});
}

// Share of the surface with paint, by the definition in double precision: every shot at every
// point, with a segment traced from the point to the muzzle.
double referenceShare(const trace::RayTracer& tracer, std::span<const lab::Shot> shots) {
  const trace::SurfacePoints surface = sample(tracer, kReferencePoints, 77);
  const auto layers = lab::oracle::layersOf(shots, {}, false);
  std::vector<double> alphas(surface.points.size());
  trace::forEach(alphas.size(), [&](size_t i) {
    const grisaille_point& point = surface.points[i];
    const glm::dvec3 position(point.position[0], point.position[1], point.position[2]);
    const glm::dvec3 normal(point.normal[0], point.normal[1], point.normal[2]);
    const auto sees = [&](const lab::Shot& shot) {
      return tests::sees(tracer, {shot.origin[0], shot.origin[1], shot.origin[2]}, position,
                         normal);
    };
    const lab::oracle::Sight sight = {.facet = normal, .sees = sees};
    alphas[i] = lab::oracle::paintOf(position, 1, 1e-9, layers, {}, sight).paint.w;
  });
  double sum = 0;
  for (const double alpha : alphas) sum += alpha;
  return sum / static_cast<double>(alphas.size());
}

}  // namespace

void printScore(const Subject& subject, const effect::Registry& registry, tests::TracedRays& rays,
                std::span<const lab::Shot> shots) {
  const auto device = gpu::makeNullDevice();
  effect::Chain chain(effect::Selection(registry, std::array<std::string, 1>{"sspm"}));
  const effect::StartedChain started(chain, *device);
  frame::Renderer renderer(*device, subject.scene);
  objects::ObjectList& list = *chain.objects("sspm");
  list.assign(objectsOf(list.table(), shots).view());
  const std::vector<std::string> outputs = {"sspm.paint"};
  renderer.render({.camera = subject.cameras[0],
                   .width = 16,
                   .height = 16,
                   .chain = &chain,
                   .outputs = outputs,
                   .services = {.rays = &rays}});
  const auto start = Clock::now();
  const trace::SurfacePoints surface = sample(rays.tracer(), kPoints, 1);
  const double sampled = secondsSince(start);
  std::vector<grisaille_drawn> drawn(surface.points.size());
  const size_t before = rays.count();
  chain.drawAt(chain.selection.entries()[0],
               {.points = surface.points, .drawn = drawn, .rays = &rays});
  const double seconds = secondsSince(start);
  double share = 0;
  for (const grisaille_drawn& one : drawn) share += double{one.alpha};
  share /= static_cast<double>(drawn.size());
  const double reference = referenceShare(rays.tracer(), shots);
  const double error = std::sqrt(reference * (1 - reference) / kReferencePoints);
  fmt::print(
      "Score of {} shots over {:.0f} m2: {:.3f} s for {} points ({:.3f} s to sample them, {} "
      "rays); "
      "share {:.4f}, by rays {:.4f} (standard error {:.4f}), difference {:.4f}.\n\n",
      shots.size(), surface.area, seconds, drawn.size(), sampled, rays.count() - before, share,
      reference, error, share - reference);
}

}  // namespace grisaille::bench
