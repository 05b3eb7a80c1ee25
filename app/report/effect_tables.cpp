// SPDX-License-Identifier: MIT
#include "app/report/effect_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/settings/presets.h"
#include "core/base/error.h"
#include "core/effect/values.h"
#include "core/objects/object.h"

namespace grisaille::app {
namespace {

const char* typeName(const grisaille_param_desc& param) {
  static constexpr const char* kNames[] = {"float", "int", "bool", "enum"};
  return kNames[param.type];
}

// " (advanced, look, used when estimator = slices)", as far as it holds.
std::string markText(const effect::Effect& effect, const grisaille_param_desc& param) {
  std::vector<std::string> marks;
  if ((param.flags & GRISAILLE_PARAM_ADVANCED) != 0) marks.emplace_back("advanced");
  if ((param.flags & GRISAILLE_PARAM_LOOK) != 0) marks.emplace_back("look");
  const std::string condition = effect::usedWhenText(effect, param);
  if (!condition.empty()) marks.push_back("used when " + condition);
  return marks.empty() ? "" : fmt::format(" ({})", fmt::join(marks, ", "));
}

// "1 ... 256 px" or "box | edge_aware".
std::string rangeText(const grisaille_param_desc& param) {
  if (param.type == GRISAILLE_PARAM_BOOL) return "true | false";
  if (param.type == GRISAILLE_PARAM_ENUM) {
    return fmt::format("{}", fmt::join(param.enum_keys, param.enum_keys + param.enum_count, " | "));
  }
  return fmt::format("{} ... {}{}{}", param.hard_min, param.hard_max, *param.unit != 0 ? " " : "",
                     param.unit);
}

const char* typeName(const objects::Field& field) {
  static constexpr const char* kNames[] = {"number",    "colour", "point",
                                           "direction", "text",   "file"};
  return kNames[field.type];
}

// "0 ... 1000000 m"; for a field without a range, its type.
std::string rangeText(const objects::Field& field) {
  if (field.type != GRISAILLE_FIELD_NUMBER) return typeName(field);
  return fmt::format("{} ... {}{}{}", field.min, field.max, *field.unit != 0 ? " " : "",
                     field.unit);
}

std::string defaultText(const objects::Field& field) {
  if ((field.flags & GRISAILLE_FIELD_REQUIRED) != 0) return "required";
  return objects::textOf(field, objects::defaultOf(field));
}

std::string placementText(const objects::Table& table) {
  const char* point = table.fields[table.point_field].key;
  const char* direction = table.fields[table.direction_field].key;
  return table.placement == GRISAILLE_PLACE_RAY
             ? fmt::format("placing sets {} to the camera's eye, {} to the pixel's ray", point,
                           direction)
             : fmt::format("placing sets {} to the visible surface, {} to its normal", point,
                           direction);
}

nlohmann::ordered_json jsonOf(const objects::Table& table) {
  nlohmann::ordered_json json = {
      {"key", table.key},
      {"label", table.label},
      {"tooltip", table.tooltip},
      {"placement", table.placement == GRISAILLE_PLACE_RAY ? "ray" : "surface"},
      {"fields", nlohmann::json::array()}};
  for (const objects::Field& field : objects::fieldsOf(table)) {
    nlohmann::ordered_json one = {
        {"key", field.key},         {"label", field.label},
        {"type", typeName(field)},  {"unit", field.unit},
        {"tooltip", field.tooltip}, {"required", (field.flags & GRISAILLE_FIELD_REQUIRED) != 0}};
    if (field.type == GRISAILLE_FIELD_NUMBER) one["range"] = {field.min, field.max};
    one["default"] = objects::textOf(field, objects::defaultOf(field));
    json["fields"].push_back(std::move(one));
  }
  return json;
}

// What an effect reads with its defaults, for all outputs. If reads() fails, the
// error's text, so that the other effects are still listed.
std::string readsText(const effect::Effect& effect) {
  std::vector<double> defaults;
  for (const grisaille_param_desc& param : effect.params()) defaults.push_back(param.default_value);
  try {
    return fmt::format("{}", fmt::join(effect::readNames(effect, defaults.data()), ", "));
  } catch (const Error& error) {
    return error.detail();
  }
}

nlohmann::ordered_json jsonOf(const effect::Effect& effect, const grisaille_param_desc& param) {
  nlohmann::ordered_json json = {{"key", param.key},
                                 {"label", param.label},
                                 {"type", typeName(param)},
                                 {"unit", param.unit},
                                 {"tooltip", param.tooltip},
                                 {"advanced", (param.flags & GRISAILLE_PARAM_ADVANCED) != 0},
                                 {"look", (param.flags & GRISAILLE_PARAM_LOOK) != 0}};
  if (param.type == GRISAILLE_PARAM_ENUM) {
    json["default"] = effect::textOf(param, param.default_value);
    for (uint32_t i = 0; i < param.enum_count; ++i) {
      json["values"].push_back({{"key", param.enum_keys[i]}, {"label", param.enum_labels[i]}});
    }
  } else if (param.type == GRISAILLE_PARAM_BOOL) {
    json["default"] = param.default_value != 0;
  } else {
    json["default"] = param.default_value;
    json["hard_range"] = {param.hard_min, param.hard_max};
    json["soft_range"] = {param.soft_min, param.soft_max};
    json["step"] = param.step;
    json["scale"] = (param.flags & GRISAILLE_PARAM_LOG) != 0 ? "log" : "linear";
    json["scene_length"] = (param.flags & GRISAILLE_PARAM_SCENE_LENGTH) != 0;
  }
  if (const auto condition = effect::usedWhen(effect, param)) {
    json["used_when"] = {{"parameter", condition->first}, {"value", condition->second}};
  }
  return json;
}

std::string valuesText(const Preset& preset) {
  std::string text;
  for (const auto& [key, value] : preset.values) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
  }
  return text;
}

// One line per preset; if the presets file cannot be read, one line with the reason.
std::string presetsText(const effect::Effect& effect) {
  std::string text;
  try {
    const Presets presets = loadPresets(effect);
    for (const Preset& preset : presets.all) {
      text += fmt::format("  preset {:<10} error {:.4f}, cost {:.2f} x balanced: {}\n", preset.name,
                          preset.error, preset.cost, valuesText(preset));
    }
    if (!presets.all.empty()) text += fmt::format("  source of the presets: {}\n", presets.study);
  } catch (const Error& error) {
    text = fmt::format("  no presets: {}\n", error.what());
  }
  return text;
}

nlohmann::ordered_json presetsJson(const effect::Effect& effect) {
  auto json = nlohmann::ordered_json::array();
  try {
    for (const Preset& preset : loadPresets(effect).all) {
      nlohmann::ordered_json values = nlohmann::json::object();
      for (const auto& [key, value] : preset.values) values[key] = value;
      json.push_back({{"name", preset.name},
                      {"error", preset.error},
                      {"cost", preset.cost},
                      {"values", values}});
    }
  } catch (const Error& error) {
    json = error.what();
  }
  return json;
}

}  // namespace

std::string effectsText(const effect::Registry& registry) {
  const std::vector<std::string> defaults = registry.defaults();
  std::string text;
  for (const effect::Effect& effect : registry.effects()) {
    const bool runs = std::ranges::count(defaults, effect.key()) > 0;
    text += fmt::format("{} {}: {}\n  {}{}\n  reads {}\n", effect.desc->key, effect.desc->version,
                        effect.desc->tooltip, runs ? "runs by default\n  " : "", effect.path,
                        readsText(effect));
    for (const grisaille_param_desc& param : effect.params()) {
      text += fmt::format("  {:<14} {:<10} {:<32} {}{}\n", param.key,
                          effect::textOf(param, param.default_value), rangeText(param),
                          param.tooltip, markText(effect, param));
    }
    for (const grisaille_output_desc& output : effect.outputs()) {
      text += fmt::format("  writes {}: {}\n", output.key, output.tooltip);
    }
    if (effect.objects() != nullptr) {
      const objects::Table& table = *effect.objects();
      text += fmt::format("  objects {}: {}; {}\n", table.key, table.tooltip, placementText(table));
      for (const objects::Field& field : objects::fieldsOf(table)) {
        text += fmt::format("    {:<12} {:<10} {:<32} {}\n", field.key, defaultText(field),
                            rangeText(field), field.tooltip);
      }
    }
    text += presetsText(effect);
  }
  for (const effect::Refused& refused : registry.refused()) {
    text += fmt::format("refused {}\n  {}\n", refused.path, refused.reason.what());
  }
  return text.empty() ? "no effects\n" : text;
}

std::string effectsJson(const effect::Registry& registry) {
  const std::vector<std::string> defaults = registry.defaults();
  nlohmann::ordered_json json = {{"effects", nlohmann::json::array()},
                                 {"refused", nlohmann::json::array()}};
  for (const effect::Effect& effect : registry.effects()) {
    nlohmann::ordered_json entry = {{"key", effect.desc->key},
                                    {"label", effect.desc->label},
                                    {"version", effect.desc->version},
                                    {"tooltip", effect.desc->tooltip},
                                    {"path", effect.path},
                                    {"parameters", nlohmann::json::array()},
                                    {"outputs", nlohmann::json::array()},
                                    {"presets", presetsJson(effect)}};
    for (const grisaille_param_desc& param : effect.params()) {
      entry["parameters"].push_back(jsonOf(effect, param));
    }
    for (const grisaille_output_desc& output : effect.outputs()) {
      entry["outputs"].push_back({{"key", output.key}, {"tooltip", output.tooltip}});
    }
    if (effect.objects() != nullptr) entry["objects"] = jsonOf(*effect.objects());
    entry["default"] = std::ranges::count(defaults, effect.key()) > 0;
    json["effects"].push_back(std::move(entry));
  }
  for (const effect::Refused& refused : registry.refused()) {
    json["refused"].push_back({{"path", refused.path},
                               {"error", static_cast<int>(refused.reason.id())},
                               {"reason", refused.reason.what()}});
  }
  return json.dump(2) + "\n";
}

std::string effectMarkdown(const effect::Effect& effect) {
  std::string text = "| parameter | default | range | what it does |\n|---|---|---|---|\n";
  const auto cell = [](std::string_view value) {
    std::string escaped;
    for (const char c : value) {
      if (c == '|') escaped += '\\';
      escaped += c;
    }
    return escaped;
  };
  for (const grisaille_param_desc& param : effect.params()) {
    const bool ofScene = (param.flags & GRISAILLE_PARAM_SCENE_LENGTH) != 0;
    text += fmt::format("| `{}`{} | {}{} | {} | {} |\n", param.key, markText(effect, param),
                        effect::textOf(param, param.default_value),
                        ofScene ? ", scaled to the scene" : "", cell(rangeText(param)),
                        cell(param.tooltip));
  }
  text += "\n| output | what it holds |\n|---|---|\n";
  for (const grisaille_output_desc& output : effect.outputs()) {
    text += fmt::format("| `{}` | {} |\n", output.key, cell(output.tooltip));
  }
  if (effect.objects() != nullptr) {
    const objects::Table& table = *effect.objects();
    text += fmt::format("\n| field of `{}` | default | range | what it is |\n|---|---|---|---|\n",
                        table.key);
    for (const objects::Field& field : objects::fieldsOf(table)) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", field.key, cell(defaultText(field)),
                          cell(rangeText(field)), cell(field.tooltip));
    }
  }
  const Presets presets = loadPresets(effect);
  if (presets.all.empty()) return text;
  text += "\n| preset | error (RMSE) | cost | values |\n|---|---|---|---|\n";
  for (const Preset& preset : presets.all) {
    text += fmt::format("| `{}` | {:.4f} | {:.2f} | {} |\n", preset.name, preset.error, preset.cost,
                        cell(valuesText(preset)));
  }
  return text;
}

}  // namespace grisaille::app
