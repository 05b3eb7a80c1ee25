// SPDX-License-Identifier: MIT
// A valid effect in C++. It copies view depth to its output through a transient texture, in two
// passes, and uses every service of the host.
#include <array>
#include <vector>

#include "grisaille/effect.hpp"
#include "shaders/copy.h"

namespace {

namespace plugin = grisaille::plugin;

enum Parameter { kGain, kEntry, kSkip, kMode };

constexpr const char* kModeKeys[] = {"once", "every-frame"};
constexpr const char* kModeLabels[] = {"Once", "Every frame"};
constexpr grisaille_param_desc kParams[] = {
    plugin::floatParam({.key = "gain",
                        .label = "Gain",
                        .unit = "m",
                        .tooltip = "Multiplies what is copied",
                        .hardMin = 0,
                        .hardMax = 100,
                        .softMin = 0.01,
                        .softMax = 10,
                        .defaultValue = 1,
                        .log = true}),
    plugin::intParam({.key = "entry",
                      .label = "Entry",
                      .tooltip = "Entry of the table",
                      .hardMin = 0,
                      .hardMax = 15,
                      .softMin = 0,
                      .softMax = 15,
                      .defaultValue = 3}),
    plugin::boolParam({.key = "skip", .label = "Skip", .tooltip = "Record nothing"}),
    plugin::enumParam({.key = "upload",
                       .label = "Upload",
                       .tooltip = "When the table is sent",
                       .keys = kModeKeys,
                       .labels = kModeLabels,
                       .defaultValue = 0,
                       .advanced = true})};
constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "copy",
                    .format = GRISAILLE_FORMAT_R32F,
                    .role = GRISAILLE_ROLE_VISIBILITY,
                    .tooltip = "View depth times gain, metres"}),
    plugin::output({.key = "second",
                    .format = GRISAILLE_FORMAT_RGBA16F,
                    .role = GRISAILLE_ROLE_OVERLAY,
                    .tooltip = "Zero everywhere"})};

class Copy {
 public:
  explicit Copy(plugin::Host host)
      : copy_(host, "copy", grisaille_shader_copy, 1),
        table_(host.buffer("table", sizeof(values_))),
        near_(host.sampler({.label = "near", .linear = false})),
        scratch_(host.texture({.label = "scratch", .width = 4, .height = 4, .mips = 2})) {}

  static uint32_t reads(plugin::Values values, uint32_t) noexcept {
    return values.get<bool>(kSkip) ? 0u : GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);
  }

  void record(const plugin::Frame& frame) {
    if (frame.value<bool>(kSkip)) return;
    if (!sent_ || frame.value<uint32_t>(kMode) == 1) {
      frame.uploadBuffer(table_, 0, values_);
      frame.uploadTexture(scratch_, std::array<float, 4>{}, 1);
      sent_ = true;
    }
    const grisaille_texture between =
        frame.transient({.label = "between", .width = frame.width(), .height = frame.height()});
    const uint32_t entry = frame.value<uint32_t>(kEntry);
    copy(frame, "in", entry, frame.attachment(GRISAILLE_VIEW_DEPTH), between);
    // The cache holds one pipeline: this call drops the pipeline that the frame has just used.
    if (frame.wanted(0)) copy(frame, "out", 15 - entry, between, frame.output(0));
    if (frame.wanted(1)) {
      const std::vector<std::array<uint16_t, 4>> zero(size_t{frame.width()} * frame.height());
      frame.uploadTexture(frame.output(1), zero);
    }
  }

 private:
  void copy(const plugin::Frame& frame, const char* pass, uint32_t entry, grisaille_texture from,
            grisaille_texture to) {
    struct Settings {
      float gain;
      float padding[3];
    };
    const grisaille_pipeline pipeline = copy_.get({plugin::specialize(0, entry)});
    const grisaille_range settings =
        frame.uniform(Settings{.gain = frame.value<float>(kGain), .padding = {}});
    frame.pass(pass, [&] {
      frame.dispatch(pipeline,
                     {plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, settings),
                      plugin::storage(0, plugin::whole(table_)), plugin::texture(0, from, near_),
                      plugin::image(0, to)},
                     plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
    });
  }

  std::array<float, 16> values_ = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  plugin::PipelineCache copy_;
  plugin::Buffer table_;
  plugin::Sampler near_;
  plugin::Texture scratch_;
  bool sent_ = false;
};

constexpr auto kCopy = plugin::effect<Copy>({.key = "copy",
                                             .label = "Copy",
                                             .version = "1.2.3",
                                             .tooltip = "Copies view depth",
                                             .params = kParams,
                                             .outputs = kOutputs});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kCopy);
