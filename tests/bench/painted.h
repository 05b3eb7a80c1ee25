// SPDX-License-Identifier: MIT
// A renderer with the paint of some shots on a scene.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/effect/chain.h"
#include "core/frame/renderer.h"
#include "core/image/image.h"
#include "lab/paint/shot.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

using Clock = std::chrono::steady_clock;

inline double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

inline const std::vector<std::string> kPaintAlone = {"sspm"}, kPaintAndAo = {"ssao", "sspm"};

class Painted {
 public:
  // effects: with sspm, in the order in which they run. All references must outlive it.
  Painted(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
          effect::RayService& rays, std::span<const std::string> effects);
  // Without the scene: frames have the attachments of `source`, so that they take little time
  // beside the effects.
  Painted(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
          effect::RayService& rays, std::span<const std::string> effects,
          frame::AttachmentSource& source);

  effect::Values& values() { return chain_.selection.values("sspm"); }

  // The list of shots, drawn from the next frame on.
  objects::ObjectList& shots() { return *chain_.objects("sspm"); }
  // Adds shots to it.
  void add(std::span<const lab::Shot> shots);

  struct View {
    const scene::Camera& camera;
    uint32_t width, height;                                     // pixels
    double patience = std::numeric_limits<double>::infinity();  // seconds for placing shots
  };
  // Renders outputs(), and waits for the device. Returns the milliseconds that it took.
  double render(const View& view);
  // Places the shots that wait, as `grisaille render` does, in frames of few pixels, each with
  // `patience` seconds for it. Returns the milliseconds that these frames took.
  double settle(double patience);

  // An output of the last frame, by its key.
  image::Image read(const std::string& output) { return renderer_.read(output); }
  std::vector<std::string>& outputs() { return outputs_; }  // at first the colour
  const effect::Report& report() const { return renderer_.report(); }

 private:
  gpu::Device& device_;
  const Subject& subject_;
  effect::RayService& rays_;
  effect::Chain chain_;
  effect::StartedChain started_;
  frame::Renderer renderer_;
  std::vector<std::string> outputs_ = {"color"};
};

}  // namespace grisaille::bench
