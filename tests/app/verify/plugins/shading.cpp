// SPDX-License-Identifier: MIT
// An effect whose shader has a fault: -DFAULT_... names it, KEY is the effect's key.
#include "grisaille/effect.hpp"
#include "shaders/fault.h"

namespace {

namespace plugin = grisaille::plugin;

constexpr grisaille_output_desc kOutputs[] = {plugin::output({.key = "first",
                                                              .format = GRISAILLE_FORMAT_R32F,
                                                              .role = GRISAILLE_ROLE_VISIBILITY,
                                                              .tooltip = "0 to 1"})};

class Shading {
 public:
  explicit Shading(plugin::Host host)
      : fault_(host.computePipeline("fault", grisaille_shader_fault)),
        nearest_(host.sampler({.label = "nearest"})),
        values_(host.buffer("values", 64 * sizeof(float))) {}

  static uint32_t reads(plugin::Values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);
  }

  void record(const plugin::Frame& frame) {
    float values[64];
    for (int i = 0; i < 64; ++i) values[i] = static_cast<float>(i + 1) / 65;
    frame.uploadBuffer(values_, 0, values);
    frame.pass("fault", [&] {
      frame.dispatch(
          fault_,
          {
#if defined(BINDS_VALUES)
            plugin::storage(0, plugin::whole(values_)),
#elif defined(BINDS_DEPTH)
                         plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), nearest_),
#endif
                plugin::image(0, frame.output(0))
          },
          plugin::groupsFor(frame.width(), 64), frame.height());
    });
  }

 private:
  plugin::Pipeline fault_;
  plugin::Sampler nearest_;
  plugin::Buffer values_;
};

constexpr auto kEffect = plugin::effect<Shading>({.key = KEY,
                                                  .label = "Shading",
                                                  .version = "1.0.0",
                                                  .tooltip = "Has a faulty shader",
                                                  .params = {},
                                                  .outputs = kOutputs});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kEffect);
