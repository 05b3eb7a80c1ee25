// SPDX-License-Identifier: MIT
// Screen-space ambient occlusion, by one of two estimators; README.md says how and why.
#include "classic.h"
#include "grisaille/effect.hpp"
#include "parameters.h"
#include "slices.h"

namespace grisaille::ssao {
namespace {

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "ao",
                    .format = GRISAILLE_FORMAT_R16F,
                    .role = GRISAILLE_ROLE_VISIBILITY,
                    .tooltip = "Ambient visibility, 0 to 1; 1 = open"})};

class Ssao {
 public:
  explicit Ssao(plugin::Host host) : slices_(host), classic_(host) {}

  static uint32_t reads(plugin::Values values) noexcept {
    return classic(values) ? Classic::reads(values) : Slices::reads();
  }

  void record(const plugin::Frame& frame) {
    if (frame.value<Estimator>(kEstimator) == Estimator::kClassic) {
      classic_.record(frame);
    } else {
      slices_.record(frame);
    }
  }

 private:
  static bool classic(plugin::Values values) noexcept {
    return values.get<Estimator>(Parameter::kEstimator) == Estimator::kClassic;
  }

  Slices slices_;
  Classic classic_;
};

constexpr auto kSsao =
    plugin::effect<Ssao>({.key = "ssao",
                          .label = "Ambient occlusion",
                          .version = "1.0.0",
                          .tooltip = "How much of the sky above each surface nearby geometry hides",
                          .params = kParams,
                          .outputs = kOutputs});

}  // namespace
}  // namespace grisaille::ssao

GRISAILLE_EXPORT_PLUGIN(&grisaille::ssao::kSsao);
