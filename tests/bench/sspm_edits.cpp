// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "backends/backends.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

constexpr double kEditPatience = 0.03;  // seconds a frame for placing, as in the viewer
constexpr double kSoon = 2;             // seconds after which the picture is looked at again
constexpr float kSame = 2.0f / 255;     // of a channel

struct Change {
  const char* parameter;
  const char* from;  // the default
  const char* to;
};
constexpr std::array<Change, 4> kChanges = {{{"paint_range", "0.25", "0.35"},
                                             {"paint_range", "0.25", "0.15"},
                                             {"r0", "1", "0.15"},
                                             {"edge_fade", "0.5", "0.2"}}};

class Edited {
 public:
  Edited(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
         tests::TracedRays& rays, std::span<const lab::Shot> shots, glm::uvec2 size)
      : camera_(subject.cameras[0]),
        size_(size),
        painted_(device, subject, registry, rays, kPaintAndAo) {
    painted_.add(shots);
    complete();
  }

  effect::Values& values() { return painted_.values(); }

  // Returns the number of shots that wait.
  uint64_t render(double patience) {
    painted_.render({camera_, size_.x, size_.y, patience});
    return painted_.report().waiting;
  }

  // The picture with all shots in their places.
  image::Image complete() {
    while (render(std::numeric_limits<double>::infinity()) > 0) {
    }
    return picture();
  }

  image::Image picture() { return painted_.read("color"); }

 private:
  const scene::Camera& camera_;
  const glm::uvec2 size_;
  Painted painted_;
};

bool differ(const image::Image& a, const image::Image& b, size_t pixel) {
  for (size_t c = 0; c < a.channels; ++c) {
    const size_t i = pixel * a.channels + c;
    if (std::abs(std::min(a.pixels[i], 1.0f) - std::min(b.pixels[i], 1.0f)) > kSame) return true;
  }
  return false;
}

// Share of the pixels that a change alters which `now` shows as they will be.
double shareRight(const image::Image& before, const image::Image& now, const image::Image& after) {
  size_t altered = 0, right = 0;
  for (size_t i = 0; i < size_t{after.width} * after.height; ++i) {
    if (!differ(before, after, i)) continue;
    ++altered;
    if (!differ(now, after, i)) ++right;
  }
  return altered == 0 ? 1 : static_cast<double>(right) / static_cast<double>(altered);
}

struct EditRow {
  double nextFrame = 0;  // milliseconds from the change
  double rightNext = 1;  // see shareRight()
  double soon = 0;       // milliseconds to the first frame that ends after kSoon
  double rightSoon = 1;  // in that frame
  uint64_t waiting = 0;  // shots to be placed anew after it
  double placed = 0;     // seconds to place these
};

EditRow measureEdit(Edited& edited, const Change& change) {
  const image::Image before = edited.complete();
  edited.values().set(change.parameter, change.to);
  EditRow row;
  double passed = 0;
  const auto timed = [&](double patience) {
    const auto start = Clock::now();
    row.waiting = edited.render(patience);
    passed += secondsSince(start);
  };
  timed(kEditPatience);
  row.nextFrame = 1000 * passed;
  const image::Image next = edited.picture();
  while (row.waiting > 0 && passed < kSoon) timed(kEditPatience);
  row.soon = 1000 * passed;
  const image::Image soon = edited.picture();
  const auto start = Clock::now();
  const image::Image after = edited.complete();
  row.placed = secondsSince(start);
  row.rightNext = shareRight(before, next, after);
  row.rightSoon = shareRight(before, soon, after);
  edited.values().set(change.parameter, change.from);
  return row;
}

}  // namespace

void printEdits(const std::string& backend, const Subject& subject,
                const effect::Registry& registry, tests::TracedRays& rays,
                std::span<const lab::Shot> shots, std::span<const size_t> counts, uint32_t width,
                uint32_t height) {
  const auto device = backends::create(backend, {});
  fmt::print(
      "## {}, {}: a changed parameter\n\n"
      "From the change to the next frame, and to the first one that ends after {:.0f} s, with "
      "{:.0f} ms a frame for placing.\n"
      "Right: of the pixels that the change alters, those within 2/255 of the picture with all "
      "shots in their\nplaces. Placing the shots that wait then takes the time in the last "
      "column, in one frame.\n\n"
      "| shots | parameter | change | next frame, ms | right in it | frame after {:.0f} s, ms | "
      "right in it | shots that wait then | to place them, s |\n"
      "|---|---|---|---|---|---|---|---|---|\n",
      subject.name, backend, kSoon, 1000 * kEditPatience, kSoon);
  for (const size_t count : counts) {
    if (count > shots.size()) continue;
    Edited edited(*device, subject, registry, rays, shots.first(count), {width, height});
    for (const Change& change : kChanges) {
      const EditRow row = measureEdit(edited, change);
      fmt::print("| {} | {} | {} to {} | {:.0f} | {:.1f} % | {:.0f} | {:.1f} % | {} | {:.1f} |\n",
                 count, change.parameter, change.from, change.to, row.nextFrame,
                 100 * row.rightNext, row.soon, 100 * row.rightSoon, row.waiting, row.placed);
      std::fflush(stdout);
    }
  }
  fmt::print("\n");
}

}  // namespace grisaille::bench
