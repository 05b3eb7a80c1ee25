// SPDX-License-Identifier: MIT
// An effect that shows what it is given: the world normals, or an input that it needs. If it is
// told to, it commits a fault that only a checking device sees.
#include "shaders/shown.h"
#include "grisaille/effect.hpp"

namespace {

namespace plugin = grisaille::plugin;

enum Parameter { kWhat, kFault };

constexpr const char* kWhatKeys[] = {"normal", "mask"};
constexpr const char* kFaultKeys[] = {"none", "unwritten", "leaves_pass"};
constexpr grisaille_param_desc kParams[] = {
    plugin::enumParam({.key = "what",
                       .label = "What",
                       .tooltip = "What it shows",
                       .keys = kWhatKeys,
                       .labels = kWhatKeys}),
    plugin::enumParam({.key = "fault",
                       .label = "Fault",
                       .tooltip = "A texture that nobody has written, or a failure inside a pass",
                       .keys = kFaultKeys,
                       .labels = kFaultKeys})};

constexpr grisaille_output_desc kOutputs[] = {plugin::output(
    {.key = "shown", .format = GRISAILLE_FORMAT_RGBA16F, .tooltip = "What it was given"})};

constexpr grisaille_input_desc kInputs[] = {
    plugin::input({.key = "mask", .tooltip = "What it shows", .required = true})};

class Shown {
 public:
  explicit Shown(plugin::Host host)
      : copy_(host, "shown", grisaille_shader_shown),
        near_(host.sampler({.label = "near", .linear = false})) {}

  static uint32_t reads(plugin::Values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_NORMAL);
  }

  void record(const plugin::Frame& frame) {
    const auto fault = frame.value<uint32_t>(kFault);
    grisaille_texture from =
        frame.value<uint32_t>(kWhat) == 0 ? frame.attachment(GRISAILLE_NORMAL) : frame.input(0);
    if (fault == 1) {
      from = frame.transient({.label = "nobody's",
                              .format = GRISAILLE_FORMAT_RGBA16F,
                              .width = frame.width(),
                              .height = frame.height()});
    }
    frame.pass("show", [&] {
      if (fault == 2) throw plugin::Failure("told to fail");
      frame.dispatch(copy_.get({}),
                     {plugin::uniform(0, frame.viewBlock()), plugin::texture(0, from, near_),
                      plugin::image(0, frame.output(0))},
                     plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
    });
  }

 private:
  plugin::PipelineCache copy_;
  plugin::Sampler near_;
};

constexpr auto kShown = plugin::effect<Shown>({.key = "shown",
                                               .label = "Shown",
                                               .version = "1.0.0",
                                               .tooltip = "Shows what it is given",
                                               .params = kParams,
                                               .outputs = kOutputs,
                                               .inputs = kInputs});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kShown);
