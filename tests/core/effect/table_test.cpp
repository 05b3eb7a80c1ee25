// SPDX-License-Identifier: MIT
// checkTable() on tables in memory: it accepts a valid one and refuses each fault by its field.
#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "core/effect/registry.h"
#include "grisaille/effect.hpp"

namespace grisaille::effect {
namespace {

uint32_t readsNothing(const double*, uint32_t) {
  return 0;
}
grisaille_result createNothing(const grisaille_host*, void**) {
  return GRISAILLE_OK;
}
grisaille_result recordNothing(void*, const grisaille_frame*) {
  return GRISAILLE_OK;
}
void destroyNothing(void*) {}

struct Decal {
  double position[3];
  float direction[3];
  float colour[3];
  double size;
  const char* picture;
};

// A plugin of two effects; tests may change every field.
struct Table {
  const char* keys[3] = {"one", "two-b", "3"};
  const char* labels[3] = {"One", "Two", "Three"};
  grisaille_param_desc params[4] = {
      plugin::floatParam({.key = "radius",
                          .label = "Radius",
                          .unit = "m",
                          .tooltip = "How far",
                          .hardMin = 0,
                          .hardMax = 100,
                          .softMin = 0.01,
                          .softMax = 10,
                          .defaultValue = 0.5,
                          .log = true}),
      plugin::intParam({.key = "size",
                        .label = "Size",
                        .unit = "px",
                        .tooltip = "How many",
                        .hardMin = -4,
                        .hardMax = 256,
                        .softMin = 0,
                        .softMax = 64,
                        .defaultValue = 64}),
      plugin::boolParam({.key = "on", .label = "On", .tooltip = "Whether", .defaultValue = true}),
      plugin::enumParam({.key = "way",
                         .label = "Way",
                         .tooltip = "Which",
                         .keys = keys,
                         .labels = labels,
                         .defaultValue = 2})};
  grisaille_output_desc outputs[2] = {plugin::output({.key = "ao",
                                                      .format = GRISAILLE_FORMAT_R8,
                                                      .role = GRISAILLE_ROLE_VISIBILITY,
                                                      .tooltip = "1 = open"}),
                                      plugin::output({.key = "overlay",
                                                      .format = GRISAILLE_FORMAT_RGBA8,
                                                      .role = GRISAILLE_ROLE_OVERLAY,
                                                      .tooltip = "Straight alpha"})};
  grisaille_input_desc inputs[2] = {
      plugin::input({.key = "ssao.ao", .tooltip = "1 = open", .required = true}),
      plugin::input({.key = "mask", .tooltip = "1 = here"})};
  grisaille_field_desc fields[5] = {plugin::field({.key = "position",
                                                   .label = "Position",
                                                   .tooltip = "Where it is",
                                                   .type = GRISAILLE_FIELD_POINT,
                                                   .offset = offsetof(Decal, position),
                                                   .required = true}),
                                    plugin::field({.key = "direction",
                                                   .label = "Direction",
                                                   .tooltip = "Where it looks",
                                                   .type = GRISAILLE_FIELD_DIRECTION,
                                                   .offset = offsetof(Decal, direction),
                                                   .defaults = {0, 0, -1}}),
                                    plugin::field({.key = "colour",
                                                   .label = "Colour",
                                                   .tooltip = "Linear",
                                                   .type = GRISAILLE_FIELD_COLOUR,
                                                   .offset = offsetof(Decal, colour),
                                                   .defaults = {1, 0.5, 0}}),
                                    plugin::field({.key = "size",
                                                   .label = "Size",
                                                   .unit = "m",
                                                   .tooltip = "How large",
                                                   .type = GRISAILLE_FIELD_NUMBER,
                                                   .offset = offsetof(Decal, size),
                                                   .min = 0,
                                                   .max = 10,
                                                   .defaults = {1}}),
                                    plugin::field({.key = "picture",
                                                   .label = "Picture",
                                                   .tooltip = "Which file",
                                                   .type = GRISAILLE_FIELD_FILE,
                                                   .offset = offsetof(Decal, picture),
                                                   .text = ""})};
  grisaille_object_desc objects = plugin::objects<Decal>({.key = "decals",
                                                          .label = "Decals",
                                                          .tooltip = "Pictures on surfaces",
                                                          .fields = fields,
                                                          .placement = GRISAILLE_PLACE_SURFACE,
                                                          .pointField = 0,
                                                          .directionField = 1});
  grisaille_effect_desc first = {.struct_size = sizeof(grisaille_effect_desc),
                                 .param_count = 4,
                                 .output_count = 2,
                                 .flags = GRISAILLE_EFFECT_DEFAULT,
                                 .key = "first",
                                 .label = "First",
                                 .version = "1.0.0",
                                 .tooltip = "What it does",
                                 .params = params,
                                 .outputs = outputs,
                                 .reads = readsNothing,
                                 .create = createNothing,
                                 .record = recordNothing,
                                 .destroy = destroyNothing,
                                 .guard_band = nullptr,
                                 .objects = &objects,
                                 .draw_at = nullptr,
                                 .needs = GRISAILLE_READS(GRISAILLE_MOTION),
                                 .input_count = 2,
                                 .inputs = inputs};
  grisaille_effect_desc second = [this] {
    grisaille_effect_desc desc = first;
    desc.key = "second";
    desc.param_count = 0;
    desc.params = nullptr;
    desc.objects = nullptr;
    desc.needs = 0;
    desc.input_count = 0;
    desc.inputs = nullptr;
    return desc;
  }();
  const grisaille_effect_desc* effects[2] = {&first, &second};
  grisaille_plugin_desc plugin = {GRISAILLE_MAGIC,
                                  GRISAILLE_ABI_MAJOR,
                                  GRISAILLE_ABI_MINOR,
                                  sizeof(grisaille_plugin_desc),
                                  2,
                                  0,
                                  effects};
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

const std::string kTooLong(4097, 'x');

struct Fault {
  const char* field;  // beginning of the message
  std::function<void(Table&)> make;
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> list = {
      {"plugin.struct_size", [](Table& t) { t.plugin.struct_size += 8; }},
      {"plugin.struct_size", [](Table& t) { t.plugin.struct_size -= 8; }},
      {"plugin.struct_size", [](Table& t) { t.plugin.struct_size = 0; }},
      {"plugin.reserved", [](Table& t) { t.plugin.reserved = 1; }},
      {"effect_count", [](Table& t) { t.plugin.effect_count = 0; }},
      {"effect_count", [](Table& t) { t.plugin.effect_count = 65; }},
      {"effects", [](Table& t) { t.plugin.effects = nullptr; }},
      {"effects[1]", [](Table& t) { t.effects[1] = nullptr; }},
      {"effects[1].key", [](Table& t) { t.second.key = "first"; }},

      {"effects[0].struct_size", [](Table& t) { t.first.struct_size += 8; }},
      {"effects[0].struct_size", [](Table& t) { t.first.struct_size = 4; }},
      {"effects[0].struct_size", [](Table& t) { t.first.struct_size -= 8; }},
      {"effects[0].flags", [](Table& t) { t.first.flags |= 8; }},
      {"effects[0].key", [](Table& t) { t.first.key = nullptr; }},
      {"effects[0].key", [](Table& t) { t.first.key = ""; }},
      {"effects[0].key", [](Table& t) { t.first.key = "1st"; }},
      {"effects[0].key", [](Table& t) { t.first.key = "First"; }},
      {"effects[0].key", [](Table& t) { t.first.key = "fir-st"; }},
      {"effects[0].key", [](Table& t) { t.first.key = "fir.st"; }},
      {"effects[0].key", [](Table& t) { t.first.key = "\xc3\xa9"; }},
      {"effects[0].label", [](Table& t) { t.first.label = nullptr; }},
      {"effects[0].version", [](Table& t) { t.first.version = ""; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "a\nb"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "a\x1b[2J"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "a\xff"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "\xc3"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "\xc0\x80"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "\xe0\x9f\xbf"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "\xed\xa0\x80"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "\xf4\x90\x80\x80"; }},
      {"effects[0].tooltip", [](Table& t) { t.first.tooltip = "\x80"; }},
      {"effects[0].reads", [](Table& t) { t.first.reads = nullptr; }},
      {"effects[0].create", [](Table& t) { t.first.create = nullptr; }},
      {"effects[0].record", [](Table& t) { t.first.record = nullptr; }},
      {"effects[0].destroy", [](Table& t) { t.first.destroy = nullptr; }},
      {"effects[0].param_count", [](Table& t) { t.first.param_count = 257; }},
      {"effects[0].params", [](Table& t) { t.first.params = nullptr; }},
      {"effects[0].output_count", [](Table& t) { t.first.output_count = 0; }},
      {"effects[0].output_count", [](Table& t) { t.first.output_count = 17; }},
      {"effects[0].outputs", [](Table& t) { t.first.outputs = nullptr; }},
      {"effects[1].outputs", [](Table& t) { t.second.outputs = nullptr; }},

      {"effects[0].params[0].struct_size", [](Table& t) { t.params[0].struct_size = 200; }},
      {"effects[0].params[0].struct_size", [](Table& t) { t.params[0].struct_size = 0; }},
      {"effects[0].params[0].type", [](Table& t) { t.params[0].type = 4; }},
      {"effects[0].params[0].flags", [](Table& t) { t.params[0].flags |= 64; }},
      {"effects[0].params[2].flags", [](Table& t) { t.params[2].flags = GRISAILLE_PARAM_LOG; }},
      {"effects[0].params[1].flags",
       [](Table& t) { t.params[1].flags = GRISAILLE_PARAM_SCENE_LENGTH; }},
      {"effects[0].params[2].flags",
       [](Table& t) { t.params[2].flags = GRISAILLE_PARAM_SCENE_LENGTH; }},
      {"effects[0].params[0].flags",
       [](Table& t) {
         t.params[0].flags |= GRISAILLE_PARAM_SCENE_LENGTH;
         t.params[0].unit = "";
       }},
      {"effects[0].params[0].flags",
       [](Table& t) {
         t.params[0] = plugin::floatParam({.key = "radius",
                                           .label = "Radius",
                                           .unit = "m",
                                           .tooltip = "How far",
                                           .hardMax = 1,
                                           .softMax = 1,
                                           .defaultValue = 0,
                                           .step = 0.1,
                                           .sceneLength = true});
       }},
      {"effects[0].params[3].flags", [](Table& t) { t.params[3].flags = GRISAILLE_PARAM_LOG; }},
      {"effects[0].params[0].enum_count", [](Table& t) { t.params[0].enum_count = 2; }},
      {"effects[0].params[0].key", [](Table& t) { t.params[0].key = nullptr; }},
      {"effects[0].params[1].key", [](Table& t) { t.params[1].key = "_size"; }},
      {"effects[0].params[3].key", [](Table& t) { t.params[3].key = "radius"; }},
      {"effects[0].params[0].label", [](Table& t) { t.params[0].label = nullptr; }},
      {"effects[0].params[0].unit", [](Table& t) { t.params[0].unit = nullptr; }},
      {"effects[0].params[0].unit", [](Table& t) { t.params[0].unit = "ft"; }},
      {"effects[0].params[0].tooltip", [](Table& t) { t.params[0].tooltip = nullptr; }},
      {"effects[0].params[0].tooltip", [](Table& t) { t.params[0].tooltip = "a\rb"; }},

      {"effects[0].params[0].used_when_key", [](Table& t) { t.params[0].used_when_key = "depth"; }},
      {"effects[0].params[0].used_when_key", [](Table& t) { t.params[0].used_when_key = "size"; }},
      {"effects[0].params[0].used_when_key", [](Table& t) { t.params[0].used_when_key = "a\nb"; }},
      {"effects[0].params[3].used_when_key", [](Table& t) { t.params[3].used_when_key = "way"; }},
      {"effects[0].params[0].used_when_value", [](Table& t) { t.params[0].used_when_value = 1; }},
      {"effects[0].params[0].used_when_value",
       [](Table& t) {
         t.params[0].used_when_key = "way";
         t.params[0].used_when_value = 3;
       }},
      {"effects[0].params[0].hard_min", [](Table& t) { t.params[0].hard_min = -kInf; }},
      {"effects[0].params[0].hard_max", [](Table& t) { t.params[0].hard_max = kInf; }},
      {"effects[0].params[0].soft_min", [](Table& t) { t.params[0].soft_min = kNan; }},
      {"effects[0].params[0].soft_max", [](Table& t) { t.params[0].soft_max = kNan; }},
      {"effects[0].params[0].default_value", [](Table& t) { t.params[0].default_value = kNan; }},
      {"effects[0].params[0].step", [](Table& t) { t.params[0].step = kNan; }},
      {"effects[0].params[0].soft_min", [](Table& t) { t.params[0].soft_min = 0; }},
      {"effects[0].params[0].soft_min", [](Table& t) { t.params[0].hard_min = 1; }},
      {"effects[0].params[0].soft_max", [](Table& t) { t.params[0].soft_max = 0.01; }},
      {"effects[0].params[0].hard_max", [](Table& t) { t.params[0].hard_max = 5; }},
      {"effects[0].params[0].default_value", [](Table& t) { t.params[0].default_value = 101; }},
      {"effects[0].params[0].default_value", [](Table& t) { t.params[0].default_value = -1; }},
      {"effects[0].params[0].step", [](Table& t) { t.params[0].step = -1; }},
      {"effects[0].params[0].step", [](Table& t) { t.params[0].flags = 0; }},

      {"effects[0].params[1].default_value", [](Table& t) { t.params[1].default_value = 1.5; }},
      {"effects[0].params[1].hard_max", [](Table& t) { t.params[1].hard_max = 256.5; }},
      {"effects[0].params[1].hard_max", [](Table& t) { t.params[1].hard_max = 1e17; }},
      {"effects[0].params[1].step", [](Table& t) { t.params[1].step = 0; }},
      {"effects[0].params[1].step", [](Table& t) { t.params[1].step = 0.5; }},
      {"effects[0].params[2].hard_max", [](Table& t) { t.params[2].hard_max = 2; }},
      {"effects[0].params[2].hard_min", [](Table& t) { t.params[2].hard_min = -1; }},
      {"effects[0].params[3].hard_max", [](Table& t) { t.params[3].hard_max = 3; }},
      {"effects[0].params[3].default_value", [](Table& t) { t.params[3].default_value = 3; }},
      {"effects[0].params[3].default_value", [](Table& t) { t.params[3].default_value = 0.5; }},
      {"effects[0].params[3].enum_count", [](Table& t) { t.params[3].enum_count = 1; }},
      {"effects[0].params[3].enum_count", [](Table& t) { t.params[3].enum_count = 65; }},
      {"effects[0].params[3].enum_keys", [](Table& t) { t.params[3].enum_keys = nullptr; }},
      {"effects[0].params[3].enum_labels", [](Table& t) { t.params[3].enum_labels = nullptr; }},
      {"effects[0].params[3].enum_keys[1]", [](Table& t) { t.keys[1] = nullptr; }},
      {"effects[0].params[3].enum_keys[2]", [](Table& t) { t.keys[2] = "one"; }},
      {"effects[0].params[3].enum_keys[0]", [](Table& t) { t.keys[0] = "a b"; }},
      {"effects[0].params[3].enum_labels[0]", [](Table& t) { t.labels[0] = nullptr; }},

      {"effects[0].outputs[0].struct_size", [](Table& t) { t.outputs[0].struct_size = 0; }},
      {"effects[0].outputs[0].format", [](Table& t) { t.outputs[0].format = 0; }},
      {"effects[0].outputs[0].format", [](Table& t) { t.outputs[0].format = 9; }},
      {"effects[0].outputs[0].format",
       [](Table& t) { t.outputs[0].format = GRISAILLE_FORMAT_R32UI; }},
      {"effects[0].outputs[1].format",
       [](Table& t) { t.outputs[1].format = GRISAILLE_FORMAT_R32F; }},
      {"effects[0].outputs[0].role", [](Table& t) { t.outputs[0].role = 6; }},
      {"effects[0].outputs[0].format", [](Table& t) { t.outputs[0].role = GRISAILLE_ROLE_COLOUR; }},
      {"effects[0].outputs[1].role",
       [](Table& t) {
         t.outputs[0].role = GRISAILLE_ROLE_COLOUR;
         t.outputs[0].format = GRISAILLE_FORMAT_RGBA16F;
       }},
      {"effects[0].needs",
       [](Table& t) { t.first.needs = GRISAILLE_READS(GRISAILLE_ATTACHMENT_COUNT); }},
      {"effects[0].input_count", [](Table& t) { t.first.input_count = 17; }},
      {"effects[0].inputs", [](Table& t) { t.first.inputs = nullptr; }},
      {"effects[0].inputs[0].struct_size", [](Table& t) { t.inputs[0].struct_size = 8; }},
      {"effects[0].inputs[0].flags", [](Table& t) { t.inputs[0].flags = 2; }},
      {"effects[0].inputs[0].key", [](Table& t) { t.inputs[0].key = "ssao."; }},
      {"effects[0].inputs[0].key", [](Table& t) { t.inputs[0].key = "a.b.c"; }},
      {"effects[0].inputs[1].key", [](Table& t) { t.inputs[1].key = "ssao.ao"; }},
      {"effects[0].inputs[1].tooltip", [](Table& t) { t.inputs[1].tooltip = nullptr; }},
      {"effects[0].outputs[0].format", [](Table& t) { t.outputs[0].role = GRISAILLE_ROLE_TINT; }},
      {"effects[0].outputs[0].format", [](Table& t) { t.outputs[0].role = GRISAILLE_ROLE_OWNER; }},
      {"effects[0].outputs[0].key", [](Table& t) { t.outputs[0].key = "A"; }},
      {"effects[0].outputs[1].key", [](Table& t) { t.outputs[1].key = "ao"; }},
      {"effects[0].outputs[0].tooltip", [](Table& t) { t.outputs[0].tooltip = ""; }},

      {"effects[0].objects.struct_size", [](Table& t) { t.objects.struct_size += 8; }},
      {"effects[0].objects.struct_size", [](Table& t) { t.objects.struct_size = 0; }},
      {"effects[0].objects.key", [](Table& t) { t.objects.key = nullptr; }},
      {"effects[0].objects.key", [](Table& t) { t.objects.key = ""; }},
      {"effects[0].objects.key", [](Table& t) { t.objects.key = "Decals"; }},
      {"effects[0].objects.key", [](Table& t) { t.objects.key = "version"; }},
      {"effects[0].objects.key", [](Table& t) { t.objects.key = "de cals"; }},
      {"effects[0].objects.label", [](Table& t) { t.objects.label = nullptr; }},
      {"effects[0].objects.label", [](Table& t) { t.objects.label = "a\nb"; }},
      {"effects[0].objects.tooltip", [](Table& t) { t.objects.tooltip = ""; }},
      {"effects[0].objects.tooltip", [](Table& t) { t.objects.tooltip = "a\xff"; }},
      {"effects[0].objects.object_size", [](Table& t) { t.objects.object_size = 0; }},
      {"effects[0].objects.object_size", [](Table& t) { t.objects.object_size = 4; }},
      {"effects[0].objects.object_size", [](Table& t) { t.objects.object_size = 60; }},
      {"effects[0].objects.object_size", [](Table& t) { t.objects.object_size = 4104; }},
      {"effects[0].objects.field_count", [](Table& t) { t.objects.field_count = 0; }},
      {"effects[0].objects.field_count", [](Table& t) { t.objects.field_count = 65; }},
      {"effects[0].objects.fields", [](Table& t) { t.objects.fields = nullptr; }},
      {"effects[0].objects.placement", [](Table& t) { t.objects.placement = 2; }},
      {"effects[0].objects.point_field", [](Table& t) { t.objects.point_field = 1; }},
      {"effects[0].objects.point_field", [](Table& t) { t.objects.point_field = 5; }},
      {"effects[0].objects.point_field", [](Table& t) { t.objects.point_field = ~0u; }},
      {"effects[0].objects.direction_field", [](Table& t) { t.objects.direction_field = 0; }},
      {"effects[0].objects.direction_field", [](Table& t) { t.objects.direction_field = 5; }},

      {"effects[0].objects.fields[0].struct_size", [](Table& t) { t.fields[0].struct_size = 0; }},
      {"effects[0].objects.fields[4].struct_size", [](Table& t) { t.fields[4].struct_size += 8; }},
      {"effects[0].objects.fields[0].key", [](Table& t) { t.fields[0].key = nullptr; }},
      {"effects[0].objects.fields[0].key", [](Table& t) { t.fields[0].key = "0th"; }},
      {"effects[0].objects.fields[3].key", [](Table& t) { t.fields[3].key = "colour"; }},
      {"effects[0].objects.fields[0].label", [](Table& t) { t.fields[0].label = ""; }},
      {"effects[0].objects.fields[0].unit", [](Table& t) { t.fields[0].unit = nullptr; }},
      {"effects[0].objects.fields[3].unit", [](Table& t) { t.fields[3].unit = "ft"; }},
      {"effects[0].objects.fields[2].unit", [](Table& t) { t.fields[2].unit = "m"; }},
      {"effects[0].objects.fields[0].tooltip", [](Table& t) { t.fields[0].tooltip = nullptr; }},
      {"effects[0].objects.fields[0].type", [](Table& t) { t.fields[0].type = 6; }},
      {"effects[0].objects.fields[0].flags", [](Table& t) { t.fields[0].flags = 2; }},
      {"effects[0].objects.fields[0].offset", [](Table& t) { t.fields[0].offset = 4; }},
      {"effects[0].objects.fields[1].offset", [](Table& t) { t.fields[1].offset = 26; }},
      {"effects[0].objects.fields[2].offset", [](Table& t) { t.fields[2].offset = 42; }},
      {"effects[0].objects.fields[3].offset", [](Table& t) { t.fields[3].offset = 52; }},
      {"effects[0].objects.fields[4].offset", [](Table& t) { t.fields[4].offset = 60; }},
      {"effects[0].objects.fields[0].offset", [](Table& t) { t.fields[0].offset = 48; }},
      {"effects[0].objects.fields[1].offset", [](Table& t) { t.fields[1].offset = 56; }},
      {"effects[0].objects.fields[3].offset", [](Table& t) { t.fields[3].offset = 64; }},
      {"effects[0].objects.fields[4].offset", [](Table& t) { t.fields[4].offset = ~0u - 7; }},
      {"effects[0].objects.fields[2].offset", [](Table& t) { t.fields[2].offset = 28; }},
      {"effects[0].objects.fields[4].offset", [](Table& t) { t.fields[4].offset = 0; }},
      {"effects[0].objects.fields[3].offset", [](Table& t) { t.fields[3].offset = 16; }},
      {"effects[0].objects.fields[3].max", [](Table& t) { t.fields[3].max = 0; }},
      {"effects[0].objects.fields[3].max", [](Table& t) { t.fields[3].min = 10; }},
      {"effects[0].objects.fields[3].max", [](Table& t) { t.fields[3].max = kNan; }},
      {"effects[0].objects.fields[3].max", [](Table& t) { t.fields[3].min = -kInf; }},
      {"effects[0].objects.fields[3].max", [](Table& t) { t.fields[3].max = kInf; }},
      {"effects[0].objects.fields[3].max", [](Table& t) { t.fields[3].min = 11; }},
      {"effects[0].objects.fields[0].max", [](Table& t) { t.fields[0].max = 1; }},
      {"effects[0].objects.fields[1].max", [](Table& t) { t.fields[1].max = 1; }},
      {"effects[0].objects.fields[2].max", [](Table& t) { t.fields[2].max = 1; }},
      {"effects[0].objects.fields[4].max", [](Table& t) { t.fields[4].max = 1; }},
      {"effects[0].objects.fields[0].max", [](Table& t) { t.fields[0].min = -1; }},
      {"effects[0].objects.fields[4].default_text",
       [](Table& t) { t.fields[4].default_text = nullptr; }},
      {"effects[0].objects.fields[0].default_text",
       [](Table& t) { t.fields[0].default_text = ""; }},
      {"effects[0].objects.fields[1].default_text",
       [](Table& t) { t.fields[1].default_text = ""; }},
      {"effects[0].objects.fields[2].default_text",
       [](Table& t) { t.fields[2].default_text = ""; }},
      {"effects[0].objects.fields[3].default_text",
       [](Table& t) { t.fields[3].default_text = ""; }},
      {"effects[0].objects.fields[0].default_value",
       [](Table& t) { t.fields[0].default_value[1] = 2e9; }},
      {"effects[0].objects.fields[0].default_value",
       [](Table& t) { t.fields[0].default_value[2] = kNan; }},
      {"effects[0].objects.fields[1].default_value",
       [](Table& t) { t.fields[1].default_value[2] = 0; }},
      {"effects[0].objects.fields[1].default_value",
       [](Table& t) { t.fields[1].default_value[0] = kInf; }},
      {"effects[0].objects.fields[2].default_value",
       [](Table& t) { t.fields[2].default_value[0] = 1.5; }},
      {"effects[0].objects.fields[2].default_value",
       [](Table& t) { t.fields[2].default_value[2] = -0.5; }},
      {"effects[0].objects.fields[3].default_value",
       [](Table& t) { t.fields[3].default_value[0] = 11; }},
      {"effects[0].objects.fields[3].default_value",
       [](Table& t) { t.fields[3].default_value[0] = kNan; }},
      {"effects[0].objects.fields[4].default_value",
       [](Table& t) { t.fields[4].default_text = kTooLong.c_str(); }},
      {"effects[0].objects.fields[4].default_value",
       [](Table& t) { t.fields[4].default_text = "a\nb"; }},
      {"effects[0].objects.fields[4].default_value",
       [](Table& t) { t.fields[4].default_text = "\xff"; }},
  };
  return list;
}

TEST(Table, ValidOnePasses) {
  const Table table;
  EXPECT_NO_THROW(checkTable(table.plugin));
}

TEST(Table, LimitsPass) {
  Table table;
  table.params[1].hard_max = 9007199254740992;
  table.params[0].default_value = table.params[0].hard_max;
  table.params[2].unit = "";
  EXPECT_NO_THROW(checkTable(table.plugin));
  table.first.param_count = 0;
  table.first.params = nullptr;
  EXPECT_NO_THROW(checkTable(table.plugin));
}

TEST(Table, TextsInAnyLanguagePass) {
  Table table;
  table.first.tooltip =
      "\xc2\x80 \xdf\xbf \xe0\xa0\x80 \xed\x9f\xbf \xee\x80\x80 \xf0\x90\x80\x80 \xf4\x8f\xbf\xbf";
  EXPECT_NO_THROW(checkTable(table.plugin));
}

TEST(Table, LimitsOfObjectsPass) {
  Table table;
  table.objects.object_size = 4096;
  table.fields[4].offset = 4088;
  table.fields[3].min = table.fields[3].default_value[0];
  table.fields[2].default_value[0] = table.fields[2].default_value[1] = 0;
  const std::string longest(4096, 'x');
  table.fields[4].default_text = longest.c_str();
  EXPECT_NO_THROW(checkTable(table.plugin));
  table.objects.field_count = 2;
  table.objects.placement = GRISAILLE_PLACE_RAY;
  EXPECT_NO_THROW(checkTable(table.plugin));
}

TEST(Table, EveryFaultIsRefusedByItsField) {
  for (size_t i = 0; i < faults().size(); ++i) {
    const Fault& fault = faults()[i];
    SCOPED_TRACE(fmt::format("fault {}: {}", i, fault.field));
    Table table;
    fault.make(table);
    try {
      checkTable(table.plugin);
      ADD_FAILURE() << "the table was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kPluginTable);
      EXPECT_EQ(error.detail().substr(0, error.detail().find(' ')), fault.field) << error.what();
    }
  }
}

TEST(Table, WrapperRefusesUnequalEnumLists) {
  const char* const keys[] = {"a", "b"};
  const char* const labels[] = {"A", "B", "C"};
  EXPECT_THROW(plugin::enumParam({.key = "e", .keys = keys, .labels = labels}),
               std::invalid_argument);
}

}  // namespace
}  // namespace grisaille::effect
