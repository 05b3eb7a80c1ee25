// SPDX-License-Identifier: MIT
// Temporal antialiasing: averages frames whose cameras differ by a part of a pixel. It reads the
// colour and the motion of the surfaces, and keeps a history.
#include <algorithm>
#include <array>
#include <utility>

#include "grisaille/effect.hpp"
#include "shaders/resolve.h"

namespace {

namespace plugin = grisaille::plugin;

enum Parameter { kFrames, kWidth };

constexpr grisaille_param_desc kParams[] = {
    plugin::intParam({.key = "frames",
                      .label = "Frames",
                      .tooltip = "Frames that the history averages; 1: no history",
                      .hardMin = 1,
                      .hardMax = 64,
                      .softMin = 1,
                      .softMax = 32,
                      .defaultValue = 16}),
    plugin::floatParam({.key = "width",
                        .label = "Width",
                        .tooltip = "Standard deviations of the neighbours within which the history "
                                   "stays; small: no ghosts, large: no noise",
                        .hardMax = 16,
                        .softMin = 0.5,
                        .softMax = 4,
                        .defaultValue = 1.5,
                        .step = 0.1})};

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "colour",
                    .format = GRISAILLE_FORMAT_RGBA16F,
                    .role = GRISAILLE_ROLE_COLOUR,
                    .tooltip = "The picture without aliasing: linear light, straight alpha"})};

constexpr grisaille_input_desc kInputs[] = {plugin::input(
    {.key = "reactive",
     .tooltip =
         "Where the history does not hold, such as on water: 0 to 1, in the first channel"})};

struct Settings {  // same as in resolve.comp
  float jitter[4];
  float frames, width, remembers, reacts;
};
GRISAILLE_CHECK_BLOCK_resolve_Settings(Settings);

// What must stay the same for the picture to come to rest.
using Place = std::array<double, 14>;

Place placeOf(const grisaille_view& view) {
  Place place = {};
  auto at = std::copy(std::begin(view.position), std::end(view.position), place.begin());
  at = std::copy(std::begin(view.world_from_view), std::end(view.world_from_view), at);
  std::copy_n(view.view_from_pixel, 2, at);
  return place;
}

class TemporalAa {
 public:
  explicit TemporalAa(plugin::Host host)
      : host_(host),
        resolve_(host.computePipeline("resolve", grisaille_shader_resolve)),
        nearest_(host.sampler({.label = "nearest"})),
        smooth_(host.sampler({.label = "smooth", .linear = true})) {}

  static uint32_t reads(plugin::Values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_COLOUR) | GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) |
           GRISAILLE_READS(GRISAILLE_MOTION);
  }

  void record(const plugin::Frame& frame) {
    fit(frame.width(), frame.height());
    const grisaille_view& view = frame.view();
    const grisaille_texture mask = frame.input(0), depth = frame.attachment(GRISAILLE_VIEW_DEPTH);
    const Settings settings = {
        .jitter = {float(view.jitter[0]), float(view.jitter[1]), jitter_[0], jitter_[1]},
        .frames = frame.value<float>(kFrames),
        .width = frame.value<float>(kWidth),
        .remembers = remembers_ ? 1.0f : 0.0f,
        .reacts = mask.id != 0 ? 1.0f : 0.0f};
    frame.pass("resolve", [&] {
      frame.dispatch(
          resolve_,
          {plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(settings)),
           plugin::texture(0, frame.attachment(GRISAILLE_COLOUR), nearest_),
           plugin::texture(1, depth, nearest_),
           plugin::texture(2, frame.attachment(GRISAILLE_MOTION), nearest_),
           plugin::texture(3, remembers_ ? grisaille_texture(then_.colour) : depth, smooth_),
           plugin::texture(4, remembers_ ? grisaille_texture(then_.count) : depth, nearest_),
           plugin::texture(5, mask.id != 0 ? mask : depth, nearest_),
           plugin::image(0, frame.output(0)), plugin::image(1, now_.colour),
           plugin::image(2, now_.count)},
          plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
    });
    std::swap(then_, now_);
    std::copy_n(settings.jitter, 2, jitter_);
    remembers_ = true;
    // A picture at rest gets better for some frames: the host renders them.
    const Place place = placeOf(view);
    rested_ = place == place_ ? rested_ + 1 : 1;
    place_ = place;
    const auto frames = frame.value<uint64_t>(kFrames);
    frame.waiting(frames - std::min(rested_, frames));
  }

 private:
  struct History {
    plugin::Texture colour, count;
  };

  // Begins the history anew if the picture has another size.
  void fit(uint32_t width, uint32_t height) {
    if (width == width_ && height == height_) return;
    for (History* one : {&then_, &now_}) {
      one->colour = host_.texture({"history", GRISAILLE_FORMAT_RGBA16F, width, height});
      one->count = host_.texture({"count", GRISAILLE_FORMAT_R16F, width, height});
    }
    width_ = width, height_ = height;
    remembers_ = false;
    rested_ = 0;
  }

  plugin::Host host_;
  plugin::Pipeline resolve_;
  plugin::Sampler nearest_, smooth_;
  History then_, now_;
  uint32_t width_ = 0, height_ = 0;  // of the history, pixels
  bool remembers_ = false;           // then_ holds the previous frame
  float jitter_[2] = {};             // of the previous frame, pixels
  Place place_ = {};
  uint64_t rested_ = 0;  // frames since the camera moved
};

constexpr auto kEffect =
    plugin::effect<TemporalAa>({.key = "temporal_aa",
                                .label = "Temporal antialiasing",
                                .version = "1.0.0",
                                .tooltip = "Averages frames with a jittered camera",
                                .params = kParams,
                                .outputs = kOutputs,
                                .keepsHistory = true,
                                .wantsJitter = true,
                                .needs = GRISAILLE_READS(GRISAILLE_MOTION),
                                .inputs = kInputs});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kEffect);
