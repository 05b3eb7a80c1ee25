// SPDX-License-Identifier: MIT
// A valid table with a parameter and a field of every kind, for targets that need no plugin.
#pragma once

#include <array>
#include <cstddef>

#include "grisaille/effect.h"

namespace grisaille::fuzz {

constexpr std::array kEnumKeys = {"full", "half", "edge-aware"};
constexpr std::array kEnumLabels = {"Full", "Half", "Edge-aware"};

constexpr grisaille_param_desc param(uint32_t type, const char* key, double low, double high,
                                     double value) {
  const bool isEnum = type == GRISAILLE_PARAM_ENUM;
  return {.struct_size = sizeof(grisaille_param_desc),
          .type = type,
          .flags = 0,
          .enum_count = isEnum ? 3u : 0u,
          .key = key,
          .label = "Label",
          .unit = type == GRISAILLE_PARAM_FLOAT ? "m" : "",
          .tooltip = "What it does",
          .hard_min = low,
          .hard_max = high,
          .soft_min = low,
          .soft_max = high,
          .default_value = value,
          .step = 1,
          .enum_keys = isEnum ? kEnumKeys.data() : nullptr,
          .enum_labels = isEnum ? kEnumLabels.data() : nullptr,
          .used_when_key = nullptr,
          .used_when_value = 0};
}

constexpr std::array kParams = {
    param(GRISAILLE_PARAM_FLOAT, "radius", 1e-6, 1e6, 0.5),
    param(GRISAILLE_PARAM_FLOAT, "offset", -1e300, 1e300, 0),
    param(GRISAILLE_PARAM_INT, "steps", -64, 9007199254740992, 6),
    param(GRISAILLE_PARAM_BOOL, "back_faces", 0, 1, 0),
    param(GRISAILLE_PARAM_ENUM, "resolution", 0, 2, 1),
};

constexpr std::array kOutputs = {
    grisaille_output_desc{.struct_size = sizeof(grisaille_output_desc),
                          .format = GRISAILLE_FORMAT_R8,
                          .role = GRISAILLE_ROLE_VISIBILITY,
                          .key = "ao",
                          .tooltip = "Visibility"},
    grisaille_output_desc{.struct_size = sizeof(grisaille_output_desc),
                          .format = GRISAILLE_FORMAT_RGBA16F,
                          .role = GRISAILLE_ROLE_OVERLAY,
                          .key = "overlay",
                          .tooltip = "Overlay"},
};

struct Object {
  double origin[3];
  float direction[3];
  float color[3];
  double range;
  const char* note;
  const char* picture;
};

constexpr grisaille_field_desc field(uint32_t type, const char* key, size_t offset,
                                     uint32_t flags = 0) {
  const bool number = type == GRISAILLE_FIELD_NUMBER;
  const bool text = type == GRISAILLE_FIELD_TEXT || type == GRISAILLE_FIELD_FILE;
  return {.struct_size = sizeof(grisaille_field_desc),
          .type = type,
          .flags = flags,
          .offset = static_cast<uint32_t>(offset),
          .key = key,
          .label = "Label",
          .unit = number ? "m" : "",
          .tooltip = "What it says",
          .min = 0,
          .max = number ? 1e6 : 0,
          .default_value = {0, 0, type == GRISAILLE_FIELD_DIRECTION ? -1.0 : 0.0},
          .default_text = text ? "" : nullptr};
}

constexpr std::array kFields = {
    field(GRISAILLE_FIELD_POINT, "origin", offsetof(Object, origin), GRISAILLE_FIELD_REQUIRED),
    field(GRISAILLE_FIELD_DIRECTION, "direction", offsetof(Object, direction),
          GRISAILLE_FIELD_REQUIRED),
    field(GRISAILLE_FIELD_COLOUR, "color", offsetof(Object, color), GRISAILLE_FIELD_REQUIRED),
    field(GRISAILLE_FIELD_NUMBER, "range", offsetof(Object, range)),
    field(GRISAILLE_FIELD_TEXT, "note", offsetof(Object, note)),
    field(GRISAILLE_FIELD_FILE, "picture", offsetof(Object, picture)),
};

constexpr grisaille_object_desc kObjects = {.struct_size = sizeof(grisaille_object_desc),
                                            .object_size = sizeof(Object),
                                            .field_count = kFields.size(),
                                            .placement = GRISAILLE_PLACE_RAY,
                                            .point_field = 0,
                                            .direction_field = 1,
                                            .key = "shots",
                                            .label = "Shots",
                                            .tooltip = "What one is",
                                            .fields = kFields.data()};

constexpr std::array<grisaille_input_desc, 1> kInputs = {
    {{.struct_size = sizeof(grisaille_input_desc),
      .flags = 0,
      .key = "ssao.ao",
      .tooltip = "What it holds"}}};

// Never called.
inline uint32_t reads(const double*, uint32_t) {
  return 0;
}
inline grisaille_result create(const grisaille_host*, void**) {
  return GRISAILLE_FAILED;
}
inline grisaille_result record(void*, const grisaille_frame*) {
  return GRISAILLE_FAILED;
}
inline void destroy(void*) {}

constexpr grisaille_effect_desc kEffect = {.struct_size = sizeof(grisaille_effect_desc),
                                           .param_count = kParams.size(),
                                           .output_count = kOutputs.size(),
                                           .flags = 0,
                                           .key = "fuzzed",
                                           .label = "Fuzzed",
                                           .version = "1.0.0",
                                           .tooltip = "Nothing",
                                           .params = kParams.data(),
                                           .outputs = kOutputs.data(),
                                           .reads = reads,
                                           .create = create,
                                           .record = record,
                                           .destroy = destroy,
                                           .guard_band = nullptr,
                                           .objects = &kObjects,
                                           .draw_at = nullptr,
                                           .needs = 0,
                                           .input_count = kInputs.size(),
                                           .inputs = kInputs.data()};

}  // namespace grisaille::fuzz
