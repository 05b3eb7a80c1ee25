// SPDX-License-Identifier: MIT
// A sound table with a parameter of every kind, for targets that need no plugin's.
#pragma once

#include <array>

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
          .enum_labels = isEnum ? kEnumLabels.data() : nullptr};
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
                          .role = GRISAILLE_ROLE_PAINT,
                          .key = "paint",
                          .tooltip = "Paint"},
};

// Never called.
inline uint32_t reads(const double*) {
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
                                           .reserved = 0,
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
                                           .flags = 0,
                                           .reserved2 = 0,
                                           .reads_for = nullptr,
                                           .guard_band = nullptr};

}  // namespace grisaille::fuzz
