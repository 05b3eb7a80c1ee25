// SPDX-License-Identifier: MIT
/// @file
/// The static tables of an effect in C++: parameters, outputs, objects. Part of effect.hpp.
///
/// All strings and arrays that a table points to are static.
#ifndef GRISAILLE_EFFECT_TABLE_HPP
#define GRISAILLE_EFFECT_TABLE_HPP

#include <cstddef>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "grisaille/effect.h"

/// The C++20 interface of an effect: see effect.hpp.
namespace grisaille::plugin {

/// @addtogroup effect_parameters
/// @{

/// The value of another parameter with which a parameter is used; see
/// grisaille_param_desc::used_when_key.
struct UsedWhen {
  const char* key = nullptr;  ///< key of an enum or bool of the same effect; null: always used
  uint32_t value = 0;         ///< index of the enum's entry, or 0 or 1 for a bool
};

/// A parameter that is a number, for floatParam().
struct FloatParam {
  const char* key = nullptr;      ///< a-z, 0-9, _; begins with a letter; unique in the effect
  const char* label = nullptr;    ///< name shown to users: "Kernel size"
  const char* unit = "";          ///< "m", "px", "rad", "s", "MB", or ""
  const char* tooltip = nullptr;  ///< one sentence, without a line break
  double hardMin = 0;             ///< least value that the host accepts
  double hardMax = 0;             ///< greatest value that the host accepts
  double softMin = 0;             ///< where the slider begins, at least hardMin
  double softMax = 0;             ///< where the slider ends, over softMin, at most hardMax
  double defaultValue = 0;        ///< from hardMin to hardMax
  double step = 0;                ///< step of the slider, over 0; may stay 0 if `log` is set
  bool log = false;               ///< whether the slider is logarithmic; softMin must be over 0
  bool advanced = false;          ///< whether the panel hides it in a folded section
  bool look = false;  ///< whether the value is a matter of taste; see #GRISAILLE_PARAM_LOOK
  /// whether it is a length of the scene, see #GRISAILLE_PARAM_SCENE_LENGTH
  bool sceneLength = false;
  UsedWhen usedWhen = {};  ///< the value of another parameter with which this one is used
};

/// A parameter that is a whole number, for intParam().
struct IntParam {
  const char* key = nullptr;      ///< a-z, 0-9, _; begins with a letter; unique in the effect
  const char* label = nullptr;    ///< name shown to users: "Samples"
  const char* unit = "";          ///< "m", "px", "rad", "s", "MB", or ""
  const char* tooltip = nullptr;  ///< one sentence, without a line break
  int32_t hardMin = 0;            ///< least value that the host accepts
  int32_t hardMax = 0;            ///< greatest value that the host accepts
  int32_t softMin = 0;            ///< where the slider begins, at least hardMin
  int32_t softMax = 0;            ///< where the slider ends, over softMin, at most hardMax
  int32_t defaultValue = 0;       ///< from hardMin to hardMax
  int32_t step = 1;               ///< step of the slider, over 0
  bool log = false;               ///< whether the slider is logarithmic; softMin must be over 0
  bool advanced = false;          ///< whether the panel hides it in a folded section
  bool look = false;       ///< whether the value is a matter of taste; see #GRISAILLE_PARAM_LOOK
  UsedWhen usedWhen = {};  ///< the value of another parameter with which this one is used
};

/// A parameter that is on or off, for boolParam().
struct BoolParam {
  const char* key = nullptr;      ///< a-z, 0-9, _; begins with a letter; unique in the effect
  const char* label = nullptr;    ///< name shown to users: "Back faces"
  const char* tooltip = nullptr;  ///< one sentence, without a line break
  bool defaultValue = false;      ///< the default
  bool advanced = false;          ///< whether the panel hides it in a folded section
  bool look = false;       ///< whether the value is a matter of taste; see #GRISAILLE_PARAM_LOOK
  UsedWhen usedWhen = {};  ///< the value of another parameter with which this one is used
};

/// A parameter that takes one value of a list, for enumParam().
struct EnumParam {
  const char* key = nullptr;            ///< a-z, 0-9, _; begins with a letter; unique in the effect
  const char* label = nullptr;          ///< name shown to users: "Method"
  const char* tooltip = nullptr;        ///< one sentence, without a line break
  std::span<const char* const> keys;    ///< static, 2 to 64 keys of a-z, 0-9, _, -; unique
  std::span<const char* const> labels;  ///< static, names shown to users, one per key
  uint32_t defaultValue = 0;            ///< index of the default
  bool advanced = false;                ///< whether the panel hides it in a folded section
  bool look = false;       ///< whether the value is a matter of taste; see #GRISAILLE_PARAM_LOOK
  UsedWhen usedWhen = {};  ///< the value of another parameter with which this one is used
};

/// Combines grisaille_param_flags.
/// @param log whether the slider is logarithmic
/// @param advanced whether the panel hides it in a folded section
/// @param look whether the value is a matter of taste
/// @param sceneLength whether it is a length of the scene
/// @return grisaille_param_desc::flags
constexpr uint32_t paramFlags(bool log, bool advanced, bool look = false,
                              bool sceneLength = false) {
  return (log ? uint32_t{GRISAILLE_PARAM_LOG} : 0u) |
         (advanced ? uint32_t{GRISAILLE_PARAM_ADVANCED} : 0u) |
         (look ? uint32_t{GRISAILLE_PARAM_LOOK} : 0u) |
         (sceneLength ? uint32_t{GRISAILLE_PARAM_SCENE_LENGTH} : 0u);
}

/// Returns the table entry of a number.
/// @param p the parameter
/// @return the entry
constexpr grisaille_param_desc floatParam(const FloatParam& p) {
  return {.struct_size = sizeof(grisaille_param_desc),
          .type = GRISAILLE_PARAM_FLOAT,
          .flags = paramFlags(p.log, p.advanced, p.look, p.sceneLength),
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
          .enum_labels = nullptr,
          .used_when_key = p.usedWhen.key,
          .used_when_value = p.usedWhen.value};
}

/// Returns the table entry of a whole number.
/// @param p the parameter
/// @return the entry
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
                                          .advanced = p.advanced,
                                          .look = p.look,
                                          .usedWhen = p.usedWhen});
  desc.type = GRISAILLE_PARAM_INT;
  return desc;
}

/// Returns the table entry of a switch.
/// @param p the parameter
/// @return the entry
constexpr grisaille_param_desc boolParam(const BoolParam& p) {
  grisaille_param_desc desc = floatParam({.key = p.key,
                                          .label = p.label,
                                          .tooltip = p.tooltip,
                                          .hardMax = 1,
                                          .softMax = 1,
                                          .defaultValue = p.defaultValue ? 1.0 : 0.0,
                                          .step = 1,
                                          .advanced = p.advanced,
                                          .look = p.look,
                                          .usedWhen = p.usedWhen});
  desc.type = GRISAILLE_PARAM_BOOL;
  return desc;
}

/// Returns the table entry of a list.
/// @param p the parameter
/// @return the entry
/// @throws std::invalid_argument fewer than two keys, or a different number of labels; in a
/// constant
///   table this is a compilation error
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
                                          .advanced = p.advanced,
                                          .look = p.look,
                                          .usedWhen = p.usedWhen});
  desc.type = GRISAILLE_PARAM_ENUM;
  desc.enum_count = static_cast<uint32_t>(p.keys.size());
  desc.enum_keys = p.keys.data();
  desc.enum_labels = p.labels.data();
  return desc;
}

/// @}
/// @addtogroup effect_pictures
/// @{

/// A texture that an effect writes, for output().
struct Output {
  const char* key = nullptr;                        ///< a key, for `--write KEY=FILE`
  grisaille_format format = GRISAILLE_FORMAT_R32F;  ///< its format
  grisaille_role role = GRISAILLE_ROLE_NONE;        ///< how the composed picture uses it
  const char* tooltip = nullptr;  ///< one line: what the channels mean, with units and range
};

/// Returns the table entry of an output.
/// @param o the output
/// @return the entry
constexpr grisaille_output_desc output(const Output& o) {
  return {.struct_size = sizeof(grisaille_output_desc),
          .format = static_cast<uint32_t>(o.format),
          .role = static_cast<uint32_t>(o.role),
          .key = o.key,
          .tooltip = o.tooltip};
}

/// A texture that an effect reads by name, for input().
struct Input {
  const char* key = nullptr;      ///< "effect.output", or a name that hosts use: "reactive"
  const char* tooltip = nullptr;  ///< one line: what the channels mean, with units and range
  bool required = false;          ///< whether the effect cannot run without it
};

/// Returns the table entry of an input.
/// @param i the input
/// @return the entry
constexpr grisaille_input_desc input(const Input& i) {
  return {.struct_size = sizeof(grisaille_input_desc),
          .flags = i.required ? uint32_t{GRISAILLE_INPUT_REQUIRED} : 0u,
          .key = i.key,
          .tooltip = i.tooltip};
}

/// @}
/// @addtogroup effect_objects
/// @{

/// A field of the objects that users make, for field().
struct Field {
  const char* key = nullptr;      ///< a key, for files and the command line; unique in the object
  const char* label = nullptr;    ///< name shown to users
  const char* unit = "";          ///< number: "m", "px", "rad", "s", "MB", or ""; other types: ""
  const char* tooltip = nullptr;  ///< one line
  grisaille_field_type type = GRISAILLE_FIELD_NUMBER;  ///< type of the field and its member
  size_t offset = 0;               ///< offsetof() of the member in the effect's struct
  double min = 0;                  ///< number: least value, finite; other types: 0
  double max = 0;                  ///< number: greatest value, finite, over min; other types: 0
  double defaults[3] = {0, 0, 0};  ///< a number uses the first; text and file: 0
  const char* text = nullptr;      ///< text, file: the default, not null; other types: null
  /// whether every object in a file must have the field; then only the panel uses the default
  bool required = false;
};

/// Returns the table entry of a field.
/// @param f the field
/// @return the entry
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

/// The objects that users make for an effect, for objects().
struct ObjectSpec {
  const char* key = nullptr;                     ///< key of the list in files: "decals"
  const char* label = nullptr;                   ///< name of the list, shown to users: "Decals"
  const char* tooltip = nullptr;                 ///< one line: what one object is
  std::span<const grisaille_field_desc> fields;  ///< static, 1 to 64 fields
  grisaille_placement placement = GRISAILLE_PLACE_RAY;  ///< how a click sets point and direction
  uint32_t pointField = 0;      ///< index of the point field that a click sets
  uint32_t directionField = 0;  ///< index of the direction field that a click sets
};

/// Returns the table of an effect's objects.
/// @tparam Object the effect's struct; Field::offset counts from its start
/// @param spec the objects
/// @return the table
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

/// @}
/// @addtogroup effect_frame
/// @{

/// A view of the parameter values of one frame.
class Values {
 public:
  /// @param values one per parameter, in the table's order
  explicit Values(const double* values) : values_(values) {}

  /// Returns one value.
  /// @tparam T float or double for a float, an integer for an int, bool for a bool, an enum for an
  ///   enum
  /// @param parameter index in the table, or an enum with the table's order
  /// @return the value
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

/// @}

}  // namespace grisaille::plugin

#endif  // GRISAILLE_EFFECT_TABLE_HPP
