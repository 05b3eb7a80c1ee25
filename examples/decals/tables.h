// SPDX-License-Identifier: MIT
// Tables of the effect. The panel, the command line and files of decals come from them.
#pragma once
#include "grisaille/effect.hpp"

namespace decals {

namespace plugin = grisaille::plugin;

struct Decal {
  double position[3];
  float direction[3];
  double size, height, depth, angle, opacity, order;
  const char *picture, *name;
};

// clang-format off
constexpr grisaille_field_desc kFields[] = {
    plugin::field({.key = "position", .label = "Position", .tooltip = "Centre of the box",
        .type = GRISAILLE_FIELD_POINT, .offset = offsetof(Decal, position), .required = true}),
    plugin::field({.key = "direction", .label = "Direction", .tooltip = "Where the picture faces",
        .type = GRISAILLE_FIELD_DIRECTION, .offset = offsetof(Decal, direction), .defaults = {0, 1}}),
    plugin::field({.key = "picture", .label = "Picture",
        .tooltip = "Picture file; a decal without a readable one is half black, half magenta",
        .type = GRISAILLE_FIELD_FILE, .offset = offsetof(Decal, picture), .text = ""}),
    plugin::field({.key = "size", .label = "Width", .unit = "m", .tooltip = "Width of the picture",
        .offset = offsetof(Decal, size), .min = 1e-3, .max = 1e4, .defaults = {1}}),
    plugin::field({.key = "height", .label = "Height", .unit = "m", .tooltip = "0: in proportion",
        .offset = offsetof(Decal, height), .max = 1e4}),
    plugin::field({.key = "depth", .label = "Depth", .unit = "m", .tooltip = "Depth of the box",
        .offset = offsetof(Decal, depth), .min = 1e-3, .max = 1e4, .defaults = {0.4}}),
    plugin::field({.key = "angle", .label = "Angle", .unit = "rad", .tooltip = "Anticlockwise turn",
        .offset = offsetof(Decal, angle), .min = -6.3, .max = 6.3}),
    plugin::field({.key = "opacity", .label = "Opacity", .tooltip = "Multiplies the picture's alpha",
        .offset = offsetof(Decal, opacity), .max = 1, .defaults = {1}}),
    plugin::field({.key = "order", .label = "Order",
        .tooltip = "The highest order is on top; of equal ones, the latest decal",
        .offset = offsetof(Decal, order), .min = -1e6, .max = 1e6}),
    plugin::field({.key = "name", .label = "Name", .tooltip = "Name in the list",
        .type = GRISAILLE_FIELD_TEXT, .offset = offsetof(Decal, name), .text = ""})};
constexpr grisaille_object_desc kDecals = plugin::objects<Decal>(
    {.key = "decals", .label = "Decals", .tooltip = "A picture projected into a box",
     .fields = kFields, .placement = GRISAILLE_PLACE_SURFACE, .pointField = 0, .directionField = 1});

enum Parameter { kOpacity, kFade, kMaxAngle };
constexpr grisaille_param_desc kParams[] = {
    plugin::floatParam({.key = "opacity", .label = "Opacity", .tooltip = "Opacity of all decals",
        .hardMax = 1, .softMax = 1, .defaultValue = 1, .step = 0.01}),
    plugin::floatParam({.key = "fade", .label = "Fade",
        .tooltip = "Share of the box's depth over which a decal fades out",
        .hardMax = 1, .softMax = 1, .defaultValue = 0.25, .step = 0.01}),
    plugin::floatParam({.key = "max_angle", .label = "Largest angle", .unit = "rad",
        .tooltip = "Surfaces turned further from a decal's direction do not show it",
        .hardMax = 3.15, .softMax = 3.15, .defaultValue = 1.2, .step = 0.05})};

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "decals", .format = GRISAILLE_FORMAT_RGBA16F,
        .role = GRISAILLE_ROLE_OVERLAY, .tooltip = "Decals: linear colour, and alpha, 0 to 1"})};

}  // namespace decals
