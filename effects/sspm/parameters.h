// SPDX-License-Identifier: MIT
// Tables of the effect: parameters, outputs and objects.
#pragma once

#include "grisaille/effect.hpp"
#include "shot.h"

namespace grisaille::sspm {

enum class Mode : uint8_t { kSurface, kPerShot };
enum class Resolution : uint8_t { kFull, kHalf, kQuarter };
enum class Refine : uint8_t { kNothing, kRims };

enum Parameter {
  kMode,
  kPaintRange,
  kFull,
  kShotLimit,
  kEdgeFade,
  kSplatScale,
  kSplatSharpness,
  kNoiseSeed,
  kResolution,
  kRefine,
  kMemory,
};

enum Output { kPaint, kCoverage, kOwner };

constexpr const char* kModeKeys[] = {"surface", "per_shot"};
constexpr const char* kModeLabels[] = {"On surfaces", "Per shot"};
constexpr const char* kResolutionKeys[] = {"full", "half", "quarter"};
constexpr const char* kResolutionLabels[] = {"Full", "Half", "Quarter"};
constexpr const char* kRefineKeys[] = {"nothing", "rims"};
constexpr const char* kRefineLabels[] = {"Nothing", "Edges and rims"};

constexpr grisaille_param_desc kParams[] = {
    plugin::enumParam({.key = "mode",
                       .label = "Mode",
                       .tooltip =
                           "On surfaces: any number of shots, paint only on the first surface "
                           "that a muzzle sees; per shot: the definition, one pass per shot, "
                           "paint also behind walls",
                       .keys = kModeKeys,
                       .labels = kModeLabels,
                       .defaultValue = 0}),
    plugin::floatParam({.key = "paint_range",
                        .label = "Paint range",
                        .unit = "m",
                        .tooltip = "How far from a shot's ray paint lands, for shots without a "
                                   "range of their own",
                        .hardMin = 1e-6,
                        .hardMax = 1e6,
                        .softMin = 0.01,
                        .softMax = 10,
                        .defaultValue = 0.25,
                        .log = true,
                        .look = true,
                        .sceneLength = true}),
    plugin::floatParam({.key = "r0",
                        .label = "Full alpha within",
                        .unit = "m",
                        .tooltip = "A shot's alpha is this distance divided by the distance to its "
                                   "ray, at most 1",
                        .hardMin = 1e-6,
                        .hardMax = 1e6,
                        .softMin = 0.01,
                        .softMax = 10,
                        .defaultValue = 1,
                        .log = true,
                        .look = true,
                        .sceneLength = true}),
    plugin::intParam({.key = "shot_limit",
                      .label = "Shot limit",
                      .tooltip =
                          "Per shot only: number of the newest shots that are drawn, each in "
                          "its own pass",
                      .hardMin = 1,
                      .hardMax = 65536,
                      .softMin = 1,
                      .softMax = 256,
                      .defaultValue = 64,
                      .log = true}),
    plugin::floatParam({.key = "edge_fade",
                        .label = "Edge fade",
                        .tooltip = "Share of the range over which a shot's strength falls to 0 at "
                                   "the rim, which breaks the rim up into a splat; 0: a hard rim",
                        .hardMin = 0,
                        .hardMax = 1,
                        .softMin = 0,
                        .softMax = 1,
                        .defaultValue = 0.5,
                        .step = 0.01,
                        .look = true}),
    plugin::floatParam({.key = "splat_scale",
                        .label = "Splat scale",
                        .unit = "m",
                        .tooltip = "Size of a splat's drops and bays: the noise's largest cells",
                        .hardMin = 1e-6,
                        .hardMax = 1e6,
                        .softMin = 0.005,
                        .softMax = 1,
                        .defaultValue = 0.06,
                        .log = true,
                        .look = true,
                        .sceneLength = true}),
    plugin::floatParam({.key = "splat_sharpness",
                        .label = "Splat sharpness",
                        .tooltip = "How hard a splat's edge is; 1: paint or nothing",
                        .hardMin = 0,
                        .hardMax = 1,
                        .softMin = 0,
                        .softMax = 1,
                        .defaultValue = 0.9,
                        .step = 0.01,
                        .look = true}),
    plugin::intParam({.key = "noise_seed",
                      .label = "Noise seed",
                      .tooltip = "Seed of the splats' noise",
                      .hardMin = 0,
                      .hardMax = 65535,
                      .softMin = 0,
                      .softMax = 100,
                      .defaultValue = 0,
                      .advanced = true,
                      .look = true}),
    plugin::enumParam({.key = "resolution",
                       .label = "Resolution",
                       .tooltip = "On surfaces only: paint is computed at every pixel, or at every "
                                  "second or fourth of a row and a column; other pixels ask only "
                                  "the shots that paint the samples around them",
                       .keys = kResolutionKeys,
                       .labels = kResolutionLabels,
                       .defaultValue = 0}),
    plugin::enumParam({.key = "refine",
                       .label = "Refine",
                       .tooltip = "Below full resolution, which other pixels are computed too: "
                                  "none; or those without a sample on their plane, and the rims of "
                                  "paint, where the samples differ",
                       .keys = kRefineKeys,
                       .labels = kRefineLabels,
                       .defaultValue = 1}),
    plugin::intParam({.key = "memory",
                      .label = "Memory",
                      .unit = "MB",
                      .tooltip = "On surfaces only: most memory for paint, host and device "
                                 "together; near it, the oldest shots get coarser edges, and the "
                                 "oldest that do not fit are not drawn",
                      .hardMin = 16,
                      .hardMax = 65536,
                      .softMin = 64,
                      .softMax = 4096,
                      .defaultValue = 256,
                      .log = true}),
};

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "paint",
                    .format = GRISAILLE_FORMAT_RGBA16F,
                    .role = GRISAILLE_ROLE_OVERLAY,
                    .tooltip = "Paint: linear colour, and alpha, 0 to 1"}),
    plugin::output({.key = "paint_coverage",
                    .format = GRISAILLE_FORMAT_R32F,
                    .role = GRISAILLE_ROLE_NONE,
                    .tooltip = "Sum of the shots' strengths, at most 1"}),
    plugin::output({.key = "paint_owner",
                    .format = GRISAILLE_FORMAT_R32UI,
                    .role = GRISAILLE_ROLE_OWNER,
                    .tooltip = "1 + the number of the shot that adds most to the alpha; 0: no "
                               "paint"}),
};

constexpr grisaille_field_desc kShotFields[] = {
    plugin::field({.key = "origin",
                   .label = "Muzzle",
                   .tooltip = "Where the shot is fired from",
                   .type = GRISAILLE_FIELD_POINT,
                   .offset = offsetof(Shot, origin),
                   .required = true}),
    plugin::field({.key = "direction",
                   .label = "Direction",
                   .tooltip = "Where the shot is fired to",
                   .type = GRISAILLE_FIELD_DIRECTION,
                   .offset = offsetof(Shot, direction),
                   .defaults = {0, 0, -1},
                   .required = true}),
    plugin::field({.key = "color",
                   .label = "Colour",
                   .tooltip = "Colour of the paint",
                   .type = GRISAILLE_FIELD_COLOUR,
                   .offset = offsetof(Shot, color),
                   .defaults = {1, 0.08f, 0.004f},
                   .required = true}),
    plugin::field(
        {.key = "range",
         .label = "Range",
         .unit = "m",
         .tooltip = "How far from its ray the shot paints; 0: same as the parameter Paint range",
         .type = GRISAILLE_FIELD_NUMBER,
         .offset = offsetof(Shot, range),
         .max = 1e6}),
};

constexpr grisaille_object_desc kShots = plugin::objects<Shot>({
    .key = "shots",
    .label = "Shots",
    .tooltip = "A shot of paint: a muzzle, a direction, a colour",
    .fields = kShotFields,
    .placement = GRISAILLE_PLACE_RAY,
    .pointField = 0,
    .directionField = 1,
});

}  // namespace grisaille::sspm
