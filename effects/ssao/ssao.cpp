// SPDX-License-Identifier: MIT
// The effect ssao: screen-space ambient occlusion by one of two estimators. README.md explains
// them.
#include "classic.h"
#include "dispatch.h"
#include "grisaille/effect.hpp"
#include "parameters.h"
#include "shaders/ssao_tint.h"
#include "slices.h"

namespace grisaille::ssao {
namespace {

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "ao",
                    .format = GRISAILLE_FORMAT_R16F,
                    .role = GRISAILLE_ROLE_VISIBILITY,
                    .tooltip = "Ambient visibility, 0 to 1; 1 = open"}),
    plugin::output(
        {.key = "bent_normal",
         .format = GRISAILLE_FORMAT_RGBA16F,
         .role = GRISAILLE_ROLE_NONE,
         .tooltip = "Cosine-weighted mean of the open directions, world, length 1; sky: 0"}),
    plugin::output({.key = "tint",
                    .format = GRISAILLE_FORMAT_RGBA16F,
                    .role = GRISAILLE_ROLE_TINT,
                    .tooltip =
                        "Visibility per colour channel, 0 to 1, with light reflected by base "
                        "colours if bounce is base_colour; 1 = open"})};

class Ssao {
 public:
  explicit Ssao(plugin::Host host)
      : slices_(host),
        classic_(host),
        tint_(host, "tint", grisaille_shader_ssao_tint),
        nearest_(host.sampler({.label = "nearest"})) {}

  static uint32_t reads(plugin::Values values, uint32_t wanted) noexcept {
    const bool slices = values.get<Estimator>(Parameter::kEstimator) == Estimator::kSlices ||
                        plugin::wants(wanted, kBentNormal);
    const bool classic = values.get<Estimator>(Parameter::kEstimator) == Estimator::kClassic;
    const bool coloured = plugin::wants(wanted, kTint) &&
                          values.get<Bounce>(Parameter::kBounce) == Bounce::kBaseColour;
    return (slices ? Slices::reads(values) : 0u) | (classic ? Classic::reads(values) : 0u) |
           (coloured ? GRISAILLE_READS(GRISAILLE_BASE_COLOUR) : 0u);
  }

  static double guardBand(plugin::Values values) noexcept {
    const bool slices = values.get<Estimator>(Parameter::kEstimator) == Estimator::kSlices;
    return slices ? values.get<double>(Parameter::kGuardBand) : 0;
  }

  void record(const plugin::Frame& frame) {
    const grisaille_texture ao = frame.wanted(kAo)
                                     ? frame.output(kAo)
                                     : frame.transient({.label = "visibility",
                                                        .format = GRISAILLE_FORMAT_R16F,
                                                        .width = frame.width(),
                                                        .height = frame.height()});
    const bool classic = frame.value<Estimator>(kEstimator) == Estimator::kClassic;
    // Only `slices` computes open directions. With `classic`, its visibility is then overwritten.
    if (!classic || frame.wanted(kBentNormal)) {
      slices_.record(frame, {.open = ao, .bent = frame.output(kBentNormal)});
    } else {
      slices_.forget();
    }
    if (classic && (frame.wanted(kAo) || frame.wanted(kTint))) classic_.record(frame, ao);
    if (frame.wanted(kTint)) frame.pass("tint", [&] { tint(frame, ao); });
  }

 private:
  void tint(const plugin::Frame& frame, grisaille_texture ao) {
    const bool coloured = frame.value<Bounce>(kBounce) == Bounce::kBaseColour;
    const grisaille_texture colour = coloured ? frame.attachment(GRISAILLE_BASE_COLOUR) : ao;
    const grisaille_binding bindings[] = {
        plugin::uniform(0, frame.viewBlock()), plugin::texture(0, ao, nearest_),
        plugin::texture(1, colour, nearest_), plugin::image(0, frame.output(kTint))};
    dispatch(frame, tint_.get({plugin::specialize(0, coloured)}), bindings, frame.width(),
             frame.height());
  }

  Slices slices_;
  Classic classic_;
  plugin::PipelineCache tint_;
  plugin::Sampler nearest_;
};

constexpr auto kSsao =
    plugin::effect<Ssao>({.key = "ssao",
                          .label = "Ambient occlusion",
                          .version = "1.0.0",
                          .tooltip = "How much of the sky above each surface nearby geometry hides",
                          .params = kParams,
                          .outputs = kOutputs,
                          .runsByDefault = true});

}  // namespace
}  // namespace grisaille::ssao

GRISAILLE_EXPORT_PLUGIN(&grisaille::ssao::kSsao);
