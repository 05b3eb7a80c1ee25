// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_spray.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "backends/backends.h"
#include "core/frame/picture_attachments.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

constexpr std::array<double, 2> kPatiences = {0.004, 0.002};  // seconds a frame for placing
constexpr size_t kSprayFrames = 300;
constexpr std::array<size_t, 3> kSprayed = {0, 1, 10};  // shots a frame; none: the machine's noise

struct Spray {
  std::vector<double> more;  // milliseconds by which a frame takes longer than one before it
  uint64_t waiting = 0;      // shots, after the last frame
  size_t later = 0;          // frames until none waits
};

// The median of some frames in which nothing is new or waits, milliseconds.
double idleFrame(Painted& painted, const Painted::View& view) {
  std::vector<double> frames(15);
  for (double& frame : frames) frame = painted.render(view);
  std::ranges::sort(frames);
  return frames[frames.size() / 2];
}

// Compares each frame with those before the first shot.
Spray spray(Painted& painted, const Painted::View& view, std::span<const lab::Shot> shots,
            size_t each) {
  Spray spray;
  const double idle = idleFrame(painted, view);
  for (size_t i = 0; i < kSprayFrames; ++i) {
    painted.add(shots.subspan(i * each, each));
    spray.more.push_back(painted.render(view) - idle);
  }
  spray.waiting = painted.report().waiting;
  for (; painted.report().waiting > 0; ++spray.later) painted.render(view);
  std::ranges::sort(spray.more);
  return spray;
}

void printRow(double patience, size_t each, const Spray& row) {
  const auto at = [&](double share) {
    return row.more[static_cast<size_t>(share * static_cast<double>(row.more.size() - 1))];
  };
  fmt::print("| {:.0f} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {} | {} |\n", 1000 * patience,
             each, at(0.5), at(0.9), at(0.99), at(1), row.waiting, row.later);
  std::fflush(stdout);
}

}  // namespace

void printSpray(const std::string& backend, const Subject& subject,
                const effect::Registry& registry, tests::TracedRays& rays,
                std::span<const lab::Shot> shots) {
  size_t sprayed = 0;
  for (const size_t each : kSprayed) sprayed += kPatiences.size() * kSprayFrames * each;
  if (shots.size() < sprayed) {
    fmt::print("Spray needs --spray-shots {} or more.\n\n", sprayed);
    return;
  }
  const auto device = backends::create(backend, {});
  constexpr uint32_t kWidth = 64, kHeight = 36;
  frame::PictureAttachments pictures(device.get());
  pictures.show(
      {.viewDepth = trace::depthImage(
           rays.tracer().castPrimary(subject.cameras[0], kWidth, kHeight), kWidth, kHeight),
       .normal = {},
       .baseColour = {}});
  Painted painted(*device, subject, registry, rays, kPaintAlone, pictures);
  painted.outputs() = {"paint"};
  painted.add(shots.first(shots.size() - sprayed));
  painted.settle(1);
  fmt::print(
      "## {}, {}: spray\n\n"
      "{} frames of few pixels, beside {} shots. How much longer they take than the median of "
      "frames "
      "without new\nshots. Rows without shots are the machine's noise.\n\n"
      "| for placing, ms | shots a frame | median, ms | 9 of 10 at most, ms | 99 of 100 at most, "
      "ms "
      "| all at most, ms | shots that wait in the end | frames until they are placed "
      "|\n|---|---|---|---|---|---|---|---|\n",
      subject.name, backend, kSprayFrames, shots.size() - sprayed);
  std::span<const lab::Shot> next = shots.last(sprayed);
  for (const double patience : kPatiences) {
    for (const size_t each : kSprayed) {
      const Painted::View view = {subject.cameras[0], kWidth, kHeight, patience};
      const Spray row = spray(painted, view, next, each);
      next = next.subspan(kSprayFrames * each);
      printRow(patience, each, row);
    }
  }
  fmt::print("\n");
}

}  // namespace grisaille::bench
