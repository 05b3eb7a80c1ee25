// SPDX-License-Identifier: MIT
// Contact shadows: short shadows of a distant light, from the depth of the picture. Two passes,
// half resolution, and a history that follows the motion of the surfaces.
#include <cmath>
#include <utility>

#include "grisaille/effect.hpp"
#include "shaders/resolve.h"
#include "shaders/trace.h"

namespace {

namespace plugin = grisaille::plugin;

enum Parameter { kAzimuth, kElevation, kLength, kThickness, kSteps, kStrength, kFrames };

// clang-format off
constexpr grisaille_param_desc kParams[] = {
    plugin::floatParam({.key = "azimuth", .label = "Azimuth", .unit = "rad",
        .tooltip = "Where the light is: from +x towards +z", .hardMin = -6.3, .hardMax = 6.3,
        .softMin = -3.2, .softMax = 3.2, .defaultValue = 2.6, .step = 0.05, .look = true}),
    plugin::floatParam({.key = "elevation", .label = "Elevation", .unit = "rad",
        .tooltip = "Height of the light above the horizon", .hardMin = -1.6, .hardMax = 1.6,
        .softMax = 1.6, .defaultValue = 0.8, .step = 0.05, .look = true}),
    plugin::floatParam({.key = "length", .label = "Length", .unit = "m",
        .tooltip = "Length of the rays towards the light", .hardMin = 1e-4, .hardMax = 1e6,
        .softMin = 0.01, .softMax = 5, .defaultValue = 0.5, .log = true, .sceneLength = true}),
    plugin::floatParam({.key = "thickness", .label = "Thickness", .unit = "m",
        .tooltip = "Thickness of what the camera sees", .hardMin = 1e-4, .hardMax = 1e6,
        .softMin = 0.01, .softMax = 5, .defaultValue = 0.25, .log = true, .sceneLength = true}),
    plugin::intParam({.key = "steps", .label = "Steps", .tooltip = "Samples of each ray",
        .hardMin = 1, .hardMax = 128, .softMin = 4, .softMax = 64, .defaultValue = 16}),
    plugin::floatParam({.key = "strength", .label = "Strength",
        .tooltip = "Share of the light that a shadow keeps off", .hardMax = 1, .softMax = 1,
        .defaultValue = 0.7, .step = 0.05, .look = true}),
    plugin::intParam({.key = "frames", .label = "Frames",
        .tooltip = "Frames that the history averages; 1: no history", .hardMin = 1, .hardMax = 64,
        .softMin = 1, .softMax = 32, .defaultValue = 8})};
// clang-format on

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "shadow",
                    .format = GRISAILLE_FORMAT_R16F,
                    .role = GRISAILLE_ROLE_VISIBILITY,
                    .tooltip = "Light that reaches the surface: 0 to 1"})};

constexpr grisaille_input_desc kInputs[] = {
    plugin::input({.key = "ssao.ao",
                   .tooltip = "Ambient visibility that the picture is multiplied with, 0 to 1"})};

struct Settings {  // same as in settings.glsl
  float light[4];
  float reach, thickness, steps, strength, frames;
  uint32_t index, remembers, has_ao;
};
GRISAILLE_CHECK_BLOCK_resolve_Settings(Settings);

class ContactShadows {
 public:
  explicit ContactShadows(plugin::Host host)
      : host_(host),
        trace_(host.computePipeline("trace", grisaille_shader_trace)),
        resolve_(host.computePipeline("resolve", grisaille_shader_resolve)),
        nearest_(host.sampler({.label = "nearest"})) {}

  static uint32_t reads(plugin::Values values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | GRISAILLE_READS(GRISAILLE_FACET_NORMAL) |
           (values.get<int>(kFrames) > 1 ? GRISAILLE_READS(GRISAILLE_MOTION) : 0u);
  }

  void record(const plugin::Frame& frame) {
    fit(frame.width(), frame.height());
    const uint32_t across = (frame.width() + 1) / 2, down = (frame.height() + 1) / 2;
    const grisaille_texture depth = frame.attachment(GRISAILLE_VIEW_DEPTH);
    const grisaille_texture motion = frame.attachment(GRISAILLE_MOTION), ao = frame.input(0);
    const grisaille_texture traced =
        frame.transient({"traced", GRISAILLE_FORMAT_RG32F, across, down});
    const grisaille_range block = frame.uniform(settingsOf(frame));
    frame.pass("trace", [&] {
      frame.dispatch(trace_,
                     {plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, block),
                      plugin::texture(0, depth, nearest_),
                      plugin::texture(1, frame.attachment(GRISAILLE_FACET_NORMAL), nearest_),
                      plugin::image(0, traced)},
                     plugin::groupsFor(across, 8), plugin::groupsFor(down, 8));
    });
    frame.pass("resolve", [&] {
      frame.dispatch(resolve_,
                     {plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, block),
                      plugin::texture(0, depth, nearest_), plugin::texture(1, traced, nearest_),
                      plugin::texture(2, motion.id != 0 ? motion : depth, nearest_),
                      plugin::texture(3, remembers_ ? grisaille_texture(then_) : depth, nearest_),
                      plugin::texture(4, ao.id != 0 ? ao : depth, nearest_),
                      plugin::image(0, frame.output(0)), plugin::image(1, now_)},
                     plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
    });
    std::swap(then_, now_);
    remembers_ = motion.id != 0;
    ++index_;
  }

 private:
  Settings settingsOf(const plugin::Frame& frame) const {
    const double azimuth = frame.value<double>(kAzimuth);
    const double elevation = frame.value<double>(kElevation), flat = std::cos(elevation);
    const double world[] = {flat * std::cos(azimuth), std::sin(elevation),
                            flat * std::sin(azimuth)};
    Settings settings = {.light = {},
                         .reach = frame.value<float>(kLength),
                         .thickness = frame.value<float>(kThickness),
                         .steps = frame.value<float>(kSteps),
                         .strength = frame.value<float>(kStrength),
                         .frames = frame.value<float>(kFrames),
                         .index = index_,
                         .remembers = remembers_ && frame.attachment(GRISAILLE_MOTION).id != 0,
                         .has_ao = frame.input(0).id != 0};
    for (int axis = 0; axis < 3; ++axis) {
      const double* column = frame.view().world_from_view + 3 * axis;
      double along = 0;
      for (int i = 0; i < 3; ++i) along += column[i] * world[i];
      settings.light[axis] = static_cast<float>(along);
    }
    return settings;
  }

  // Begins the history anew if the picture has another size.
  void fit(uint32_t width, uint32_t height) {
    if (width == width_ && height == height_) return;
    for (plugin::Texture* one : {&then_, &now_}) {
      *one = host_.texture({"history", GRISAILLE_FORMAT_RGBA16F, width, height});
    }
    width_ = width, height_ = height;
    remembers_ = false;
  }

  plugin::Host host_;
  plugin::Pipeline trace_, resolve_;
  plugin::Sampler nearest_;
  plugin::Texture then_, now_;       // history of the previous frame and of this one
  uint32_t width_ = 0, height_ = 0;  // of the history, pixels
  bool remembers_ = false;           // then_ holds the previous frame
  uint32_t index_ = 0;               // of the frame
};

constexpr auto kEffect = plugin::effect<ContactShadows>({.key = "contact_shadows",
                                                         .label = "Contact shadows",
                                                         .version = "1.0.0",
                                                         .tooltip = "Short shadows of a light",
                                                         .params = kParams,
                                                         .outputs = kOutputs,
                                                         .keepsHistory = true,
                                                         .inputs = kInputs});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kEffect);
