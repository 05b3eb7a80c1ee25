// SPDX-License-Identifier: MIT
// Depth of field: blurs the picture as a lens does that is focused at one distance. It reads the
// colour of the picture and writes a new one.
#include "grisaille/effect.hpp"
#include "shaders/gather.h"
#include "shaders/radius.h"

namespace {

namespace plugin = grisaille::plugin;

enum Parameter { kFocus, kAperture, kLargest, kSamples };

constexpr grisaille_param_desc kParams[] = {
    plugin::floatParam({.key = "focus",
                        .label = "Focus",
                        .unit = "m",
                        .tooltip = "View depth of the surfaces that are sharp",
                        .hardMin = 0.001,
                        .hardMax = 1e6,
                        .softMin = 0.1,
                        .softMax = 100,
                        .defaultValue = 4,
                        .log = true,
                        .sceneLength = true}),
    plugin::floatParam({.key = "aperture",
                        .label = "Aperture",
                        .unit = "m",
                        .tooltip = "Diameter of the lens; 0: everything is sharp",
                        .hardMax = 1e6,
                        .softMax = 0.5,
                        .defaultValue = 0.05,
                        .step = 0.005,
                        .look = true,
                        .sceneLength = true}),
    plugin::floatParam({.key = "largest",
                        .label = "Largest radius",
                        .unit = "px",
                        .tooltip = "Largest radius of the blur",
                        .hardMin = 1,
                        .hardMax = 64,
                        .softMin = 4,
                        .softMax = 64,
                        .defaultValue = 16,
                        .step = 1}),
    plugin::intParam({.key = "samples",
                      .label = "Samples",
                      .tooltip = "Samples of each blurred pixel",
                      .hardMin = 8,
                      .hardMax = 256,
                      .softMin = 16,
                      .softMax = 128,
                      .defaultValue = 64,
                      .step = 8})};

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "colour",
                    .format = GRISAILLE_FORMAT_RGBA16F,
                    .role = GRISAILLE_ROLE_COLOUR,
                    .tooltip = "The picture through the lens: linear light, straight alpha"})};

struct Lens {  // same as in lens.glsl
  float focus, aperture, largest, samples;
};
GRISAILLE_CHECK_BLOCK_gather_Lens(Lens);

constexpr uint32_t kTile = 16;  // pixels, as in lens.glsl

class DepthOfField {
 public:
  explicit DepthOfField(plugin::Host host)
      : radius_(host.computePipeline("radius", grisaille_shader_radius)),
        gather_(host.computePipeline("gather", grisaille_shader_gather)),
        nearest_(host.sampler({.label = "nearest"})) {}

  static uint32_t reads(plugin::Values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | GRISAILLE_READS(GRISAILLE_COLOUR);
  }

  void record(const plugin::Frame& frame) {
    const grisaille_range lens =
        frame.uniform(Lens{frame.value<float>(kFocus), frame.value<float>(kAperture),
                           frame.value<float>(kLargest), frame.value<float>(kSamples)});
    const uint32_t across = plugin::groupsFor(frame.width(), kTile);
    const uint32_t down = plugin::groupsFor(frame.height(), kTile);
    const auto picture = [&](const char* label, uint32_t width, uint32_t height) {
      return frame.transient({label, GRISAILLE_FORMAT_R16F, width, height});
    };
    const grisaille_texture radius = picture("radius", frame.width(), frame.height());
    const grisaille_texture tiles = picture("tiles", across, down);
    frame.pass("radius", [&] {
      frame.dispatch(radius_,
                     {plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, lens),
                      plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), nearest_),
                      plugin::image(0, radius), plugin::image(1, tiles)},
                     across, down);
    });
    frame.pass("gather", [&] {
      frame.dispatch(gather_,
                     {plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, lens),
                      plugin::texture(0, frame.attachment(GRISAILLE_COLOUR), nearest_),
                      plugin::texture(1, radius, nearest_), plugin::texture(2, tiles, nearest_),
                      plugin::image(0, frame.output(0))},
                     across, down);
    });
  }

 private:
  plugin::Pipeline radius_, gather_;
  plugin::Sampler nearest_;
};

constexpr auto kEffect =
    plugin::effect<DepthOfField>({.key = "depth_of_field",
                                  .label = "Depth of field",
                                  .version = "1.0.0",
                                  .tooltip = "Blurs the picture as a lens does",
                                  .params = kParams,
                                  .outputs = kOutputs});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kEffect);
