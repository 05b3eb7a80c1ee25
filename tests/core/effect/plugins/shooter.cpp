// SPDX-License-Identifier: MIT
// An effect that takes shots and casts rays, well or badly, and writes down what it was given.
#include <array>
#include <cmath>

#include "grisaille/effect.hpp"

namespace {

namespace plugin = grisaille::plugin;

enum Parameter { kCasts, kWaits };

constexpr const char* kCastKeys[] = {"none",          "two",      "nan_origin", "long_direction",
                                     "nan_direction", "no_reach", "nan_reach",  "null"};
constexpr grisaille_param_desc kParams[] = {
    plugin::enumParam({.key = "casts",
                       .label = "Casts",
                       .tooltip = "Which rays, the second of two being at fault",
                       .keys = kCastKeys,
                       .labels = kCastKeys}),
    plugin::intParam({.key = "waits",
                      .label = "Waits",
                      .tooltip = "What it says that waits; under 0: nothing",
                      .hardMin = -1,
                      .hardMax = 100,
                      .softMin = -1,
                      .softMax = 100,
                      .defaultValue = -1})};

// Texels: number of shots, how many were kept, patience, the last shot's x, whether rays are cast,
// kind and distance of two hits.
constexpr grisaille_output_desc kOutputs[] = {plugin::output(
    {.key = "told", .format = GRISAILLE_FORMAT_R32F, .tooltip = "What it was told"})};

class Shooter {
 public:
  explicit Shooter(plugin::Host host) : host_(host) {}

  static uint32_t reads(plugin::Values) noexcept { return 0; }

  void record(const plugin::Frame& frame) {
    const int32_t waits = frame.value<int32_t>(kWaits);
    if (waits >= 0) frame.waiting(static_cast<uint64_t>(waits));
    std::vector<float> told(size_t{frame.width()} * frame.height());
    const auto shots = frame.shots();
    told[0] = static_cast<float>(shots.size());
    told[1] = static_cast<float>(frame.shotsKept());
    told[2] = static_cast<float>(frame.patience());
    told[3] = shots.empty() ? 0 : static_cast<float>(shots.back().origin[0]);
    std::array<grisaille_hit, 2> hits = {};
    told[4] = cast(frame.value<int32_t>(kCasts), hits) ? 1 : 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      told[5 + 2 * i] = static_cast<float>(hits[i].kind);
      told[6 + 2 * i] = hits[i].distance;
    }
    frame.uploadTexture(frame.output(0), told);
  }

 private:
  bool cast(int32_t which, std::array<grisaille_hit, 2>& hits) const {
    std::array<grisaille_ray, 2> rays = {
        {{{1, 2, 3}, {0, 1, 0}, INFINITY}, {{0, 0, 0}, {0, 0, -1}, 5}}};
    switch (which) {
      case 0:
        return false;
      case 2:
        rays[1].origin[2] = NAN;
        break;
      case 3:
        rays[1].direction[2] = 1.0011f;
        break;
      case 4:
        rays[1].direction[0] = NAN;
        break;
      case 5:
        rays[1].reach = 0;
        break;
      case 6:
        rays[1].reach = NAN;
        break;
      case 7:
        return host_.castRays({static_cast<grisaille_ray*>(nullptr), 2}, hits);
      default:
        rays[1].direction[2] = -1.0009f;
    }
    return host_.castRays(rays, hits);
  }

  plugin::Host host_;
};

constexpr auto kShooter = plugin::effect<Shooter>({.key = "shooter",
                                                   .label = "Shooter",
                                                   .version = "1.0.0",
                                                   .tooltip = "Tells what it was given",
                                                   .params = kParams,
                                                   .outputs = kOutputs,
                                                   .takesShots = true});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kShooter);
