// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_muzzles.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "backends/backends.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

// The pictures of a shot: effects/sspm/muzzle.h.
constexpr uint32_t kSize = 256;  // pixels
const std::array<std::string, 1> kOutputs = {"depth"};
constexpr std::array<double, 5> kSlopes = {4, 0.8, 0.16, 0.032, 0.0064};

// Casts rays as the program does, and measures the time that it takes.
class TimedRays : public effect::RayService {
 public:
  explicit TimedRays(tests::TracedRays& rays) : rays_(rays) {}
  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    const auto start = Clock::now();
    rays_.cast(rays, hits);
    took_ += 1000 * secondsSince(start);
  }
  double took() const { return took_; }  // milliseconds

 private:
  tests::TracedRays& rays_;
  double took_ = 0;
};

// Milliseconds that the effect's rays take while it places the shots.
double placeByRays(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
                   TimedRays& rays, std::span<const lab::Shot> shots) {
  Painted painted(device, subject, registry, rays, kPaintAlone);
  painted.add(shots);
  const double before = rays.took();
  painted.settle(1);
  return rays.took() - before;
}

scene::Camera cameraOf(const lab::Shot& shot, double slope) {
  const glm::dvec3 eye(shot.origin[0], shot.origin[1], shot.origin[2]);
  const glm::dvec3 way(shot.direction[0], shot.direction[1], shot.direction[2]);
  return {.eye = eye,
          .target = eye + way,
          .up = std::abs(way.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0),
          .fovyDegrees = 2 * std::atan(slope) * 180 / std::numbers::pi};
}

// Milliseconds for drawing the shots' pictures and reading them back.
double drawPictures(frame::Renderer& renderer, gpu::Device& device,
                    std::span<const lab::Shot> shots) {
  const auto start = Clock::now();
  for (const lab::Shot& shot : shots) {
    for (const double slope : kSlopes) {
      renderer.render(
          {.camera = cameraOf(shot, slope), .width = kSize, .height = kSize, .outputs = kOutputs});
      renderer.read("depth");
    }
  }
  device.wait();
  return 1000 * secondsSince(start);
}

}  // namespace

void printMuzzles(const std::string& backend, const Subject& subject,
                  const effect::Registry& registry, tests::TracedRays& rays,
                  std::span<const lab::Shot> shots) {
  const auto device = backends::create(backend, {});
  frame::Renderer renderer(*device, subject.scene);
  TimedRays timed(rays);
  drawPictures(renderer, *device, shots.first(1));  // pipelines are made by the first
  const auto each = static_cast<double>(shots.size());
  const size_t before = rays.count();
  const double byRays = placeByRays(*device, subject, registry, timed, shots) / each;
  const auto asked = static_cast<double>(rays.count() - before) / each;
  const double byPictures = drawPictures(renderer, *device, shots) / each;
  fmt::print(
      "### What a muzzle sees\n\n| way | asked for a shot | ms a shot |\n|---|---|---|\n"
      "| rays, by the program's ray tracer | {:.0f} rays | {:.2f} |\n"
      "| depth pictures of {} x {}, drawn and read back | {} pictures | {:.2f} |\n\n",
      asked, byRays, kSize, kSize, kSlopes.size(), byPictures);
  std::fflush(stdout);
}

}  // namespace grisaille::bench
