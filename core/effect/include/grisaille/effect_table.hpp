// SPDX-License-Identifier: MIT
// The static tables of an effect, written in C++: parameters and outputs. Part of effect.hpp.
#ifndef GRISAILLE_EFFECT_TABLE_HPP
#define GRISAILLE_EFFECT_TABLE_HPP

#include <cstddef>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "grisaille/effect.h"

namespace grisaille::plugin {

// All text is static. See grisaille_param_desc for the meaning, units and limits of each field.
struct FloatParam {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* unit = "";
  const char* tooltip = nullptr;
  double hardMin = 0;
  double hardMax = 0;
  double softMin = 0;
  double softMax = 0;
  double defaultValue = 0;
  double step = 0;  // may stay 0 where log is set
  bool log = false;
  bool advanced = false;
};

struct IntParam {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* unit = "";
  const char* tooltip = nullptr;
  int32_t hardMin = 0;
  int32_t hardMax = 0;
  int32_t softMin = 0;
  int32_t softMax = 0;
  int32_t defaultValue = 0;
  int32_t step = 1;
  bool log = false;
  bool advanced = false;
};

struct BoolParam {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* tooltip = nullptr;
  bool defaultValue = false;
  bool advanced = false;
};

struct EnumParam {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* tooltip = nullptr;
  std::span<const char* const> keys;    // static, as long as labels
  std::span<const char* const> labels;  // static
  uint32_t defaultValue = 0;            // index
  bool advanced = false;
};

constexpr uint32_t paramFlags(bool log, bool advanced) {
  return (log ? uint32_t{GRISAILLE_PARAM_LOG} : 0u) |
         (advanced ? uint32_t{GRISAILLE_PARAM_ADVANCED} : 0u);
}

constexpr grisaille_param_desc floatParam(const FloatParam& p) {
  return {.struct_size = sizeof(grisaille_param_desc),
          .type = GRISAILLE_PARAM_FLOAT,
          .flags = paramFlags(p.log, p.advanced),
          .enum_count = 0,
          .key = p.key,
          .label = p.label,
          .unit = p.unit,
          .tooltip = p.tooltip,
          .hard_min = p.hardMin,
          .hard_max = p.hardMax,
          .soft_min = p.softMin,
          .soft_max = p.softMax,
          .default_value = p.defaultValue,
          .step = p.step,
          .enum_keys = nullptr,
          .enum_labels = nullptr};
}

constexpr grisaille_param_desc intParam(const IntParam& p) {
  grisaille_param_desc desc = floatParam({.key = p.key,
                                          .label = p.label,
                                          .unit = p.unit,
                                          .tooltip = p.tooltip,
                                          .hardMin = static_cast<double>(p.hardMin),
                                          .hardMax = static_cast<double>(p.hardMax),
                                          .softMin = static_cast<double>(p.softMin),
                                          .softMax = static_cast<double>(p.softMax),
                                          .defaultValue = static_cast<double>(p.defaultValue),
                                          .step = static_cast<double>(p.step),
                                          .log = p.log,
                                          .advanced = p.advanced});
  desc.type = GRISAILLE_PARAM_INT;
  return desc;
}

constexpr grisaille_param_desc boolParam(const BoolParam& p) {
  grisaille_param_desc desc = floatParam({.key = p.key,
                                          .label = p.label,
                                          .tooltip = p.tooltip,
                                          .hardMax = 1,
                                          .softMax = 1,
                                          .defaultValue = p.defaultValue ? 1.0 : 0.0,
                                          .step = 1,
                                          .advanced = p.advanced});
  desc.type = GRISAILLE_PARAM_BOOL;
  return desc;
}

constexpr grisaille_param_desc enumParam(const EnumParam& p) {
  if (p.keys.size() != p.labels.size() || p.keys.size() < 2) {
    throw std::invalid_argument("an enum needs two entries or more, each with key and label");
  }
  const double last = static_cast<double>(p.keys.size() - 1);
  grisaille_param_desc desc = floatParam({.key = p.key,
                                          .label = p.label,
                                          .tooltip = p.tooltip,
                                          .hardMax = last,
                                          .softMax = last,
                                          .defaultValue = static_cast<double>(p.defaultValue),
                                          .step = 1,
                                          .advanced = p.advanced});
  desc.type = GRISAILLE_PARAM_ENUM;
  desc.enum_count = static_cast<uint32_t>(p.keys.size());
  desc.enum_keys = p.keys.data();
  desc.enum_labels = p.labels.data();
  return desc;
}

struct Output {
  const char* key = nullptr;
  grisaille_format format = GRISAILLE_FORMAT_R32F;
  grisaille_role role = GRISAILLE_ROLE_NONE;
  const char* tooltip = nullptr;
};

constexpr grisaille_output_desc output(const Output& o) {
  return {.struct_size = sizeof(grisaille_output_desc),
          .format = static_cast<uint32_t>(o.format),
          .role = static_cast<uint32_t>(o.role),
          .key = o.key,
          .tooltip = o.tooltip};
}

// A field of the objects that users make, as grisaille_field_desc has it.
struct Field {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* unit = "";
  const char* tooltip = nullptr;
  grisaille_field_type type = GRISAILLE_FIELD_NUMBER;
  size_t offset = 0;  // offsetof(the effect's struct, the member)
  double min = 0;     // of a number
  double max = 0;
  double defaults[3] = {0, 0, 0};
  const char* text = nullptr;  // the default of a text or a file
  bool required = false;       // in files
};

constexpr grisaille_field_desc field(const Field& f) {
  return {.struct_size = sizeof(grisaille_field_desc),
          .type = static_cast<uint32_t>(f.type),
          .flags = f.required ? uint32_t{GRISAILLE_FIELD_REQUIRED} : 0u,
          .offset = static_cast<uint32_t>(f.offset),
          .key = f.key,
          .label = f.label,
          .unit = f.unit,
          .tooltip = f.tooltip,
          .min = f.min,
          .max = f.max,
          .default_value = {f.defaults[0], f.defaults[1], f.defaults[2]},
          .default_text = f.text};
}

// The objects that users make for an effect, as grisaille_object_desc has them.
struct ObjectSpec {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* tooltip = nullptr;
  std::span<const grisaille_field_desc> fields;  // static
  grisaille_placement placement = GRISAILLE_PLACE_RAY;
  uint32_t pointField = 0;  // by index
  uint32_t directionField = 0;
};

// `Object`: the effect's struct, which the fields' offsets are of.
template <typename Object>
constexpr grisaille_object_desc objects(const ObjectSpec& spec) {
  static_assert(std::is_standard_layout_v<Object>, "a table of offsets needs a plain struct");
  return {.struct_size = sizeof(grisaille_object_desc),
          .object_size = sizeof(Object),
          .field_count = static_cast<uint32_t>(spec.fields.size()),
          .placement = static_cast<uint32_t>(spec.placement),
          .point_field = spec.pointField,
          .direction_field = spec.directionField,
          .key = spec.key,
          .label = spec.label,
          .tooltip = spec.tooltip,
          .fields = spec.fields.data()};
}

// The parameter values of one frame, by index in the table or by an enum that counts like it. A
// view.
class Values {
 public:
  explicit Values(const double* values) : values_(values) {}

  // T: float or double for a float, an integer for an int, bool, an enum for an enum.
  template <typename T, typename Index>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> T get(Index parameter)
  const {
    const double value = values_[static_cast<size_t>(parameter)];
    if constexpr (std::is_same_v<T, bool>) {
      return value != 0;
    } else if constexpr (std::is_enum_v<T>) {
      return static_cast<T>(static_cast<std::underlying_type_t<T>>(value));
    } else {
      return static_cast<T>(value);
    }
  }

 private:
  const double* values_;
};

}  // namespace grisaille::plugin

#endif  // GRISAILLE_EFFECT_TABLE_HPP
