// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "backends/backends.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

constexpr size_t kShotsAFrame = 200;    // shots that come between two frames
constexpr double kFramePatience = 0.1;  // seconds for placing shots in a frame
constexpr uint32_t kUnlimited = 65536;
constexpr uint32_t kRim = 2;  // pixels from a change of the owner that count as a rim

struct Picture {
  std::vector<float> paint, owner;
};

// A session with paint and a limit of memory.
class Session {
 public:
  Session(gpu::Device& device, const Subject& subject, const effect::Registry& registry,
          tests::TracedRays& rays, uint32_t limit)
      : painted_(device, subject, registry, rays, kPaintAlone) {
    painted_.outputs() = {"sspm.paint", "sspm.paint_owner"};
    painted_.values().set("memory", std::to_string(limit));
    painted_.values().set("resolution", "full");
  }

  void fire(std::span<const lab::Shot> shots) {
    for (size_t had = 0; had < shots.size(); had += kShotsAFrame) {
      painted_.add(shots.subspan(had, std::min(kShotsAFrame, shots.size() - had)));
      painted_.settle(kFramePatience);
    }
  }

  Picture look(const scene::Camera& camera, uint32_t width, uint32_t height) {
    painted_.render({camera, width, height, kFramePatience});
    return {painted_.read("sspm.paint").pixels, painted_.read("sspm.paint_owner").pixels};
  }

  const effect::Report& report() const { return painted_.report(); }

 private:
  Painted painted_;
};

struct Difference {
  size_t painted = 0, different = 0;       // pixels with paint away from rims
  size_t newest = 0, newestDifferent = 0;  // pixels with paint of the newest quarter of the shots

  // newest: owners from this on are the newest quarter.
  void add(const Picture& exact, const Picture& coarse, uint32_t width, uint32_t height,
           float newestOwner) {
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        const size_t i = size_t{y} * width + x;
        if (exact.owner[i] == 0) continue;
        float apart = 0;
        for (size_t c = 4 * i; c < 4 * i + 4; ++c) {
          apart = std::max(apart, std::abs(exact.paint[c] - coarse.paint[c]));
        }
        if (exact.owner[i] >= newestOwner) {
          ++newest;
          newestDifferent += apart > 2.0f / 255 ? 1 : 0;
        }
        if (isRim(exact.owner, x, y, width, height)) continue;
        ++painted;
        different += apart > 2.0f / 255 ? 1 : 0;
      }
    }
  }

 private:
  static bool isRim(const std::vector<float>& owner, uint32_t x, uint32_t y, uint32_t width,
                    uint32_t height) {
    const float own = owner[size_t{y} * width + x];
    for (uint32_t v = y - std::min(y, kRim); v <= std::min(y + kRim, height - 1); ++v) {
      for (uint32_t u = x - std::min(x, kRim); u <= std::min(x + kRim, width - 1); ++u) {
        if (owner[size_t{v} * width + u] != own) return true;
      }
    }
    return false;
  }
};

double percent(size_t part, size_t whole) {
  return whole > 0 ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

}  // namespace

void printLimits(const std::string& backend, const Subject& subject,
                 const effect::Registry& registry, tests::TracedRays& rays,
                 std::span<const lab::Shot> shots, const std::vector<uint32_t>& limits,
                 uint32_t width, uint32_t height) {
  const auto device = backends::create(backend, {});
  fmt::print(
      "## {}, {}: {} shots at the limit of memory\n\nDifferent: by more than 2/255 from exact "
      "paint. "
      "A rim: within {} pixels of a change of the owner.\n\n"
      "| memory, MB | coarser | given up | pixels away from rims | different | pixels of the "
      "newest "
      "quarter | different |\n|---|---|---|---|---|---|---|\n",
      subject.name, backend, shots.size(), kRim);
  for (const uint32_t limit : limits) {
    fmt::print(stderr, "limit: {} MB\n", limit);
    Session limited(*device, subject, registry, rays, limit);
    limited.fire(shots);
    const auto givenUp = static_cast<size_t>(limited.report().givenUp);
    const std::span<const lab::Shot> left = shots.subspan(givenUp);
    Session exact(*device, subject, registry, rays, kUnlimited);
    exact.fire(left);
    Difference sum;
    for (const scene::Camera& camera : subject.cameras) {
      sum.add(exact.look(camera, width, height), limited.look(camera, width, height), width, height,
              static_cast<float>(left.size() * 3 / 4 + 2));
    }
    fmt::print("| {} | {} | {} | {} | {:.2f} % | {} | {:.2f} % |\n", limit,
               limited.report().coarser, givenUp, sum.painted, percent(sum.different, sum.painted),
               sum.newest, percent(sum.newestDifferent, sum.newest));
    std::fflush(stdout);
  }
  fmt::print("\n");
}

}  // namespace grisaille::bench
