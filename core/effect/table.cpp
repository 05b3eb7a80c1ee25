// SPDX-License-Identifier: MIT
// Checks a plugin's tables, field by field, by the rules of grisaille/effect.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/base/utf8.h"
#include "core/effect/parameter_name.h"
#include "core/effect/registry.h"
#include "core/effect/struct_version.h"
#include "core/objects/object.h"

namespace grisaille::effect {
namespace {

constexpr uint32_t kMaxEffects = 64;
constexpr uint32_t kMaxParams = 256;
constexpr uint32_t kMaxOutputs = 16;
constexpr uint32_t kMaxInputs = 16;
constexpr uint32_t kMaxEnumEntries = 64;
constexpr uint32_t kParamFlags = GRISAILLE_PARAM_LOG | GRISAILLE_PARAM_ADVANCED |
                                 GRISAILLE_PARAM_SCENE_LENGTH | GRISAILLE_PARAM_LOOK;
constexpr uint32_t kMaxFields = 64;
constexpr uint32_t kMaxObjectSize = 4096;
constexpr uint32_t kEffectFlags =
    GRISAILLE_EFFECT_DEFAULT | GRISAILLE_EFFECT_HISTORY | GRISAILLE_EFFECT_JITTER;
// Size of the struct in each version, this program's first.
constexpr std::initializer_list<size_t> kEffectDescSizes = {sizeof(grisaille_effect_desc)};
constexpr double kMaxWhole = 9007199254740992;  // 2^53: beyond it a double skips whole numbers
constexpr std::array<std::string_view, 6> kUnits = {"", "m", "px", "rad", "s", "MB"};

// `what` continues the sentence after the field's path: "is 3, over 2".
template <typename... Args>
[[noreturn]] void refuse(const std::string& field, fmt::format_string<Args...> what,
                         Args&&... args) {
  throw Error(ErrorId::kPluginTable, "{} {}", field,
              fmt::format(what, std::forward<Args>(args)...));
}

void checkCount(const std::string& field, uint32_t count, uint32_t least, uint32_t most) {
  if (count < least || count > most) refuse(field, "is {}, outside {} to {}", count, least, most);
}

void checkZero(const std::string& field, uint32_t value) {
  if (value != 0) refuse(field, "is {}, must be 0", value);
}

void checkFlags(const std::string& owner, uint32_t flags, uint32_t known) {
  if ((flags & ~known) != 0) {
    refuse(owner + ".flags", "is {:#x}, but this program knows only {:#x}", flags, known);
  }
}

template <typename Pointer>
void checkPresent(const std::string& field, Pointer pointer) {
  if (pointer == nullptr) refuse(field, "is null");
}

// One line of UTF-8: the panel shows it, and JSON requires UTF-8.
void checkLine(const std::string& field, const char* text) {
  checkPresent(field, text);
  if (*text == '\0') refuse(field, "is empty");
  for (const char* c = text; *c != '\0'; ++c) {
    if (static_cast<unsigned char>(*c) < 0x20 || *c == 0x7f) {
      refuse(field, "holds the control character {:#04x}", static_cast<unsigned char>(*c));
    }
  }
  const size_t wrong = invalidUtf8(text);
  if (wrong != std::string_view::npos) {
    refuse(field, "holds the byte {:#04x}, which is not valid UTF-8",
           static_cast<unsigned char>(text[wrong]));
  }
}

void checkKey(const std::string& field, const char* key) {
  checkLine(field, key);
  if (!isKey(key)) {
    refuse(field, "is \"{}\", must be of a-z, 0-9, _ and begin with a letter", oneLine(key));
  }
}

// The caller has checked `keyOf(n)` for n < index.
template <typename KeyOf>
void checkUnique(const std::string& list, const char* member, uint32_t index, KeyOf&& keyOf) {
  const std::string_view key = keyOf(index);
  for (uint32_t i = 0; i < index; ++i) {
    if (key == keyOf(i)) {
      refuse(fmt::format("{}[{}]{}", list, index, member), "is \"{}\", the same as {}[{}]{}", key,
             list, i, member);
    }
  }
}

void checkEnum(const std::string& at, const grisaille_param_desc& param) {
  checkCount(at + ".enum_count", param.enum_count, 2, kMaxEnumEntries);
  checkPresent(at + ".enum_keys", param.enum_keys);
  checkPresent(at + ".enum_labels", param.enum_labels);
  for (uint32_t i = 0; i < param.enum_count; ++i) {
    const std::string field = fmt::format("{}.enum_keys[{}]", at, i);
    checkLine(field, param.enum_keys[i]);
    const std::string_view key = param.enum_keys[i];
    if (!std::ranges::all_of(key, [](char c) { return isKeyLetter(c) || c == '-'; })) {
      refuse(field, "is \"{}\", must be of a-z, 0-9, _, -", oneLine(key));
    }
    checkUnique(at + ".enum_keys", "", i, [&](uint32_t n) { return param.enum_keys[n]; });
    checkLine(fmt::format("{}.enum_labels[{}]", at, i), param.enum_labels[i]);
  }
}

void checkType(const std::string& at, const grisaille_param_desc& param) {
  if (param.type > GRISAILLE_PARAM_ENUM) refuse(at + ".type", "is {}, not a type", param.type);
  checkFlags(at, param.flags, kParamFlags);
  const bool isEnum = param.type == GRISAILLE_PARAM_ENUM;
  if (isEnum) {
    checkEnum(at, param);
  } else {
    checkZero(at + ".enum_count", param.enum_count);
  }
  const bool isBool = param.type == GRISAILLE_PARAM_BOOL;
  if ((isEnum || isBool) && (param.flags & GRISAILLE_PARAM_LOG) != 0) {
    refuse(at + ".flags", "sets GRISAILLE_PARAM_LOG, which only floats and ints may have");
  }
  if (isEnum || isBool) {
    const double last = isBool ? 1.0 : param.enum_count - 1.0;
    if (param.hard_min != 0) refuse(at + ".hard_min", "is {}, must be 0", param.hard_min);
    if (param.hard_max != last) refuse(at + ".hard_max", "is {}, must be {}", param.hard_max, last);
  }
}

void checkRange(const std::string& at, const grisaille_param_desc& p) {
  if (p.soft_min < p.hard_min) {
    refuse(at + ".soft_min", "is {}, under hard_min {}", p.soft_min, p.hard_min);
  }
  if (p.soft_max <= p.soft_min) {
    refuse(at + ".soft_max", "is {}, not over soft_min {}", p.soft_max, p.soft_min);
  }
  if (p.hard_max < p.soft_max) {
    refuse(at + ".hard_max", "is {}, under soft_max {}", p.hard_max, p.soft_max);
  }
  if (p.default_value < p.hard_min || p.default_value > p.hard_max) {
    refuse(at + ".default_value", "is {}, outside {} to {}", p.default_value, p.hard_min,
           p.hard_max);
  }
  const bool log = (p.flags & GRISAILLE_PARAM_LOG) != 0;
  if (log && p.soft_min <= 0) {
    refuse(at + ".soft_min", "is {}, not over 0 as a logarithmic scale needs", p.soft_min);
  }
  if (p.step < 0 || (p.step == 0 && !log)) refuse(at + ".step", "is {}, not over 0", p.step);
}

void checkNumbers(const std::string& at, const grisaille_param_desc& param) {
  struct Named {
    const char* name;
    double value;
  };
  for (const Named& n :
       {Named{".hard_min", param.hard_min}, Named{".hard_max", param.hard_max},
        Named{".soft_min", param.soft_min}, Named{".soft_max", param.soft_max},
        Named{".default_value", param.default_value}, Named{".step", param.step}}) {
    if (!std::isfinite(n.value)) refuse(at + n.name, "is {}, which is not finite", n.value);
    if (param.type == GRISAILLE_PARAM_FLOAT) continue;
    if (n.value != std::trunc(n.value)) refuse(at + n.name, "is {}, which is not whole", n.value);
    if (std::abs(n.value) > kMaxWhole) refuse(at + n.name, "is {}, beyond 2^53", n.value);
  }
}

void checkUnit(const std::string& at, const char* unit) {
  checkPresent(at + ".unit", unit);
  if (std::ranges::find(kUnits, unit) == kUnits.end()) {
    refuse(at + ".unit", "is \"{}\", must be m, px, rad, s, MB or empty", oneLine(unit));
  }
}

void checkSceneLength(const std::string& at, const grisaille_param_desc& param) {
  if ((param.flags & GRISAILLE_PARAM_SCENE_LENGTH) == 0) return;
  if (param.type != GRISAILLE_PARAM_FLOAT || std::string_view(param.unit) != "m" ||
      !(param.default_value > 0)) {
    refuse(at + ".flags",
           "sets GRISAILLE_PARAM_SCENE_LENGTH, which only floats with the unit m and a default "
           "over 0 may have");
  }
}

// Needs checked parameters.
void checkUsedWhen(const std::string& at, const grisaille_effect_desc& effect,
                   const grisaille_param_desc& param) {
  if (param.used_when_key == nullptr)
    return checkZero(at + ".used_when_value", param.used_when_value);
  checkLine(at + ".used_when_key", param.used_when_key);
  const std::string_view key = param.used_when_key;
  const std::span params(effect.params, effect.param_count);
  const auto other = std::ranges::find(params, key, &grisaille_param_desc::key);
  if (other == params.end() || key == param.key ||
      (other->type != GRISAILLE_PARAM_ENUM && other->type != GRISAILLE_PARAM_BOOL)) {
    refuse(at + ".used_when_key",
           "is \"{}\", must be the key of another parameter that is an enum "
           "or a bool",
           oneLine(key));
  }
  if (param.used_when_value > other->hard_max) {
    refuse(at + ".used_when_value", "is {}, over the {} of {}", param.used_when_value,
           other->hard_max, key);
  }
}

void checkParam(const std::string& at, const grisaille_param_desc& param) {
  checkStructSize(at, param.struct_size, {sizeof(grisaille_param_desc)});
  checkKey(at + ".key", param.key);
  checkLine(at + ".label", param.label);
  checkUnit(at, param.unit);
  checkLine(at + ".tooltip", param.tooltip);
  checkType(at, param);
  checkNumbers(at, param);
  checkRange(at, param);
  checkSceneLength(at, param);
}

void checkOutput(const std::string& at, const grisaille_output_desc& output) {
  checkStructSize(at, output.struct_size, {sizeof(grisaille_output_desc)});
  checkKey(at + ".key", output.key);
  checkLine(at + ".tooltip", output.tooltip);
  const uint32_t format = output.format;
  if (format < GRISAILLE_FORMAT_R8 || format > GRISAILLE_FORMAT_R32UI) {
    refuse(at + ".format", "is {}, which is not a grisaille_format", format);
  }
  if (output.role > GRISAILLE_ROLE_COLOUR) {
    refuse(at + ".role", "is {}, which is not a grisaille_role", output.role);
  }
  if (output.role == GRISAILLE_ROLE_VISIBILITY && format == GRISAILLE_FORMAT_R32UI) {
    refuse(at + ".format", "is {}, an integer format, which cannot be a visibility", format);
  }
  if (output.role == GRISAILLE_ROLE_OWNER && format != GRISAILLE_FORMAT_R32UI) {
    refuse(at + ".format", "is {}, must be GRISAILLE_FORMAT_R32UI for an owner", format);
  }
  if (output.role == GRISAILLE_ROLE_COLOUR && format != GRISAILLE_FORMAT_RGBA16F) {
    refuse(at + ".format", "is {}, must be GRISAILLE_FORMAT_RGBA16F for a colour", format);
  }
  const bool coloured = output.role == GRISAILLE_ROLE_OVERLAY || output.role == GRISAILLE_ROLE_TINT;
  if (coloured && format != GRISAILLE_FORMAT_RGBA8 && format != GRISAILLE_FORMAT_RGBA16F &&
      format != GRISAILLE_FORMAT_RGBA32F) {
    refuse(at + ".format", "is {}, which does not have four channels", format);
  }
}

bool isComposed(const grisaille_output_desc& output) {
  return output.role != GRISAILLE_ROLE_NONE && output.role != GRISAILLE_ROLE_OWNER;
}

// Needs checked outputs.
void checkColour(const std::string& at, const grisaille_effect_desc& effect) {
  const std::span outputs(effect.outputs, effect.output_count);
  const auto colour =
      std::ranges::find(outputs, uint32_t{GRISAILLE_ROLE_COLOUR}, &grisaille_output_desc::role);
  if (colour == outputs.end()) return;
  for (size_t i = 0; i < outputs.size(); ++i) {
    if (&outputs[i] == &*colour || !isComposed(outputs[i])) continue;
    refuse(fmt::format("{}.outputs[{}].role", at, i),
           "is {}, but outputs[{}] is the colour of the picture, which replaces all layers",
           outputs[i].role, colour - outputs.begin());
  }
}

// "key" or "key.key"
void checkInput(const std::string& at, const grisaille_input_desc& input) {
  checkStructSize(at, input.struct_size, {sizeof(grisaille_input_desc)});
  checkFlags(at, input.flags, GRISAILLE_INPUT_REQUIRED);
  checkLine(at + ".tooltip", input.tooltip);
  checkLine(at + ".key", input.key);
  const std::string_view key = input.key;
  const size_t dot = key.find('.');
  const bool sound = dot == std::string_view::npos
                         ? isKey(key)
                         : isKey(key.substr(0, dot)) && isKey(key.substr(dot + 1));
  if (!sound) refuse(at + ".key", "is \"{}\", must be a key or EFFECT.OUTPUT", oneLine(key));
}

void checkInputs(const std::string& at, const grisaille_effect_desc& effect) {
  if ((effect.needs >> GRISAILLE_ATTACHMENT_COUNT) != 0) {
    refuse(at + ".needs", "is {:#x}, which has bits of no attachment", effect.needs);
  }
  checkCount(at + ".input_count", effect.input_count, 0, kMaxInputs);
  if (effect.input_count > 0) checkPresent(at + ".inputs", effect.inputs);
  for (uint32_t i = 0; i < effect.input_count; ++i) {
    checkInput(fmt::format("{}.inputs[{}]", at, i), effect.inputs[i]);
    checkUnique(at + ".inputs", ".key", i, [&](uint32_t n) { return effect.inputs[n].key; });
  }
}

// Bytes of one element and number of elements, by grisaille_field_type.
constexpr std::array<uint32_t, 6> kElementSizes = {8, 4, 8, 4, sizeof(char*), sizeof(char*)};
constexpr std::array<uint32_t, 6> kElements = {1, 3, 3, 3, 1, 1};

uint64_t endOf(const grisaille_field_desc& field) {
  return uint64_t{field.offset} + uint64_t{kElementSizes[field.type]} * kElements[field.type];
}

// The caller has checked the fields before it.
void checkFieldPlace(const std::string& at, uint32_t index, const grisaille_object_desc& object) {
  const grisaille_field_desc& field = object.fields[index];
  const uint32_t element = kElementSizes[field.type];
  const uint64_t end = endOf(field);
  if (field.offset % element != 0) {
    refuse(at + ".offset", "is {}, not a multiple of {}", field.offset, element);
  }
  if (end > object.object_size) {
    refuse(at + ".offset", "is {}, which ends {} bytes into an object of {}", field.offset, end,
           object.object_size);
  }
  for (const grisaille_field_desc& other : std::span(object.fields, index)) {
    if (field.offset < endOf(other) && other.offset < end) {
      refuse(at + ".offset", "is {}, inside the field {}", field.offset, other.key);
    }
  }
}

void checkFieldValues(const std::string& at, const grisaille_field_desc& field) {
  const bool number = field.type == GRISAILLE_FIELD_NUMBER;
  const bool text = field.type == GRISAILLE_FIELD_TEXT || field.type == GRISAILLE_FIELD_FILE;
  if (number && !(std::isfinite(field.min) && std::isfinite(field.max) && field.min < field.max)) {
    refuse(at + ".max", "is {}, must be over min {}, and both finite", field.max, field.min);
  }
  if (!number && (field.min != 0 || field.max != 0)) refuse(at + ".max", "is only for numbers");
  if (text) {
    checkPresent(at + ".default_text", field.default_text);
  } else if (field.default_text != nullptr) {
    refuse(at + ".default_text", "is only for texts and files");
  }
  try {
    objects::checked(field, objects::defaultOf(field));
  } catch (const Error& error) {
    refuse(at + ".default_value", "does not fit: {}", error.detail());
  }
}

void checkField(const std::string& at, uint32_t index, const grisaille_object_desc& object) {
  const grisaille_field_desc& field = object.fields[index];
  checkStructSize(at, field.struct_size, {sizeof(grisaille_field_desc)});
  checkKey(at + ".key", field.key);
  checkLine(at + ".label", field.label);
  checkUnit(at, field.unit);
  checkLine(at + ".tooltip", field.tooltip);
  if (field.type > GRISAILLE_FIELD_FILE) refuse(at + ".type", "is {}, not a type", field.type);
  checkFlags(at, field.flags, GRISAILLE_FIELD_REQUIRED);
  if (field.type != GRISAILLE_FIELD_NUMBER && *field.unit != '\0') {
    refuse(at + ".unit", "is \"{}\", must be empty: only numbers have a unit", field.unit);
  }
  checkFieldPlace(at, index, object);
  checkFieldValues(at, field);
}

void checkPlacement(const std::string& at, const grisaille_object_desc& object) {
  if (object.placement > GRISAILLE_PLACE_SURFACE) {
    refuse(at + ".placement", "is {}, which is not a grisaille_placement", object.placement);
  }
  const auto type = [&](uint32_t index) {
    return index < object.field_count ? object.fields[index].type : ~0u;
  };
  if (type(object.point_field) != GRISAILLE_FIELD_POINT) {
    refuse(at + ".point_field", "is {}, which is not the index of a point field",
           object.point_field);
  }
  if (type(object.direction_field) != GRISAILLE_FIELD_DIRECTION) {
    refuse(at + ".direction_field", "is {}, which is not the index of a direction field",
           object.direction_field);
  }
}

void checkObjects(const std::string& at, const grisaille_object_desc& object) {
  checkStructSize(at, object.struct_size, {sizeof(grisaille_object_desc)});
  checkKey(at + ".key", object.key);
  if (std::string_view(object.key) == "version") refuse(at + ".key", "is reserved in files");
  checkLine(at + ".label", object.label);
  checkLine(at + ".tooltip", object.tooltip);
  if (object.object_size == 0 || object.object_size % 8 != 0 ||
      object.object_size > kMaxObjectSize) {
    refuse(at + ".object_size", "is {}, not a multiple of 8 up to {}", object.object_size,
           kMaxObjectSize);
  }
  checkCount(at + ".field_count", object.field_count, 1, kMaxFields);
  checkPresent(at + ".fields", object.fields);
  for (uint32_t i = 0; i < object.field_count; ++i) {
    checkField(fmt::format("{}.fields[{}]", at, i), i, object);
    checkUnique(at + ".fields", ".key", i, [&](uint32_t n) { return object.fields[n].key; });
  }
  checkPlacement(at, object);
}

void checkEffect(const std::string& at, const grisaille_effect_desc* desc) {
  checkPresent(at, desc);
  checkStructSize(at, desc->struct_size, kEffectDescSizes);
  const grisaille_effect_desc effect = whole(desc);
  checkKey(at + ".key", effect.key);
  checkLine(at + ".label", effect.label);
  checkLine(at + ".version", effect.version);
  checkLine(at + ".tooltip", effect.tooltip);
  checkFlags(at, effect.flags, kEffectFlags);
  checkPresent(at + ".reads", effect.reads);
  checkPresent(at + ".create", effect.create);
  checkPresent(at + ".record", effect.record);
  checkPresent(at + ".destroy", effect.destroy);

  checkCount(at + ".param_count", effect.param_count, 0, kMaxParams);
  if (effect.param_count > 0) checkPresent(at + ".params", effect.params);
  for (uint32_t i = 0; i < effect.param_count; ++i) {
    checkParam(fmt::format("{}.params[{}]", at, i), effect.params[i]);
    checkUnique(at + ".params", ".key", i, [&](uint32_t n) { return effect.params[n].key; });
  }
  for (uint32_t i = 0; i < effect.param_count; ++i) {
    checkUsedWhen(fmt::format("{}.params[{}]", at, i), effect, effect.params[i]);
  }
  checkCount(at + ".output_count", effect.output_count, 1, kMaxOutputs);
  checkPresent(at + ".outputs", effect.outputs);
  for (uint32_t i = 0; i < effect.output_count; ++i) {
    checkOutput(fmt::format("{}.outputs[{}]", at, i), effect.outputs[i]);
    checkUnique(at + ".outputs", ".key", i, [&](uint32_t n) { return effect.outputs[n].key; });
  }
  checkColour(at, effect);
  checkInputs(at, effect);
  if (effect.objects != nullptr) checkObjects(at + ".objects", *effect.objects);
}

}  // namespace

void checkTable(const grisaille_plugin_desc& plugin) {
  checkStructSize("plugin", plugin.struct_size, {sizeof(grisaille_plugin_desc)});
  checkZero("plugin.reserved", plugin.reserved);
  checkCount("effect_count", plugin.effect_count, 1, kMaxEffects);
  checkPresent("effects", plugin.effects);
  for (uint32_t i = 0; i < plugin.effect_count; ++i) {
    const std::string at = fmt::format("effects[{}]", i);
    checkEffect(at, plugin.effects[i]);
    checkUnique("effects", ".key", i, [&](uint32_t n) { return plugin.effects[n]->key; });
  }
}

}  // namespace grisaille::effect
