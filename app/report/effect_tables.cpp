// SPDX-License-Identifier: MIT
#include "app/report/effect_tables.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "app/settings/presets.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

const char* typeName(const grisaille_param_desc& param) {
  static constexpr const char* kNames[] = {"float", "int", "bool", "enum"};
  return kNames[param.type];
}

std::string valueText(const grisaille_param_desc& param, double value) {
  if (param.type == GRISAILLE_PARAM_ENUM) return param.enum_keys[static_cast<size_t>(value)];
  if (param.type == GRISAILLE_PARAM_BOOL) return value != 0 ? "true" : "false";
  return fmt::format("{}", value);
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

// With its defaults, for all outputs; an effect that cannot tell does not keep the others from it.
std::string readsText(const effect::Effect& effect) {
  std::vector<double> defaults;
  for (const grisaille_param_desc& param : effect.params()) defaults.push_back(param.default_value);
  try {
    const uint32_t reads = effect.reads(defaults.data(), ~0u);
    return fmt::format("{}", fmt::join(effect::attachmentNames(reads), ", "));
  } catch (const Error& error) {
    return error.detail();
  }
}

nlohmann::ordered_json jsonOf(const grisaille_param_desc& param) {
  nlohmann::ordered_json json = {
      {"key", param.key},         {"label", param.label},
      {"type", typeName(param)},  {"unit", param.unit},
      {"tooltip", param.tooltip}, {"advanced", (param.flags & GRISAILLE_PARAM_ADVANCED) != 0}};
  if (param.type == GRISAILLE_PARAM_ENUM) {
    json["default"] = valueText(param, param.default_value);
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

// A line each; where the file cannot be read, why not.
std::string presetsText(const effect::Effect& effect) {
  std::string text;
  try {
    const Presets presets = loadPresets(effect);
    for (const Preset& preset : presets.all) {
      text += fmt::format("  preset {:<10} error {:.4f}, cost {:.2f} of balanced: {}\n",
                          preset.name, preset.error, preset.cost, valuesText(preset));
    }
    if (!presets.all.empty()) text += fmt::format("  presets by {}\n", presets.study);
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
  std::string text;
  for (const effect::Effect& effect : registry.effects()) {
    text += fmt::format("{} {}: {}\n  {}\n  reads {}\n", effect.desc->key, effect.desc->version,
                        effect.desc->tooltip, effect.path, readsText(effect));
    for (const grisaille_param_desc& param : effect.params()) {
      text += fmt::format("  {:<14} {:<10} {:<32} {}\n", param.key,
                          valueText(param, param.default_value), rangeText(param), param.tooltip);
    }
    for (const grisaille_output_desc& output : effect.outputs()) {
      text += fmt::format("  writes {}: {}\n", output.key, output.tooltip);
    }
    text += presetsText(effect);
  }
  for (const effect::Refused& refused : registry.refused()) {
    text += fmt::format("refused {}\n  {}\n", refused.path, refused.reason.what());
  }
  return text.empty() ? "no effects\n" : text;
}

std::string effectsJson(const effect::Registry& registry) {
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
      entry["parameters"].push_back(jsonOf(param));
    }
    for (const grisaille_output_desc& output : effect.outputs()) {
      entry["outputs"].push_back({{"key", output.key}, {"tooltip", output.tooltip}});
    }
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
    text += fmt::format("| `{}`{} | {} | {} | {} |\n", param.key,
                        (param.flags & GRISAILLE_PARAM_ADVANCED) != 0 ? " (advanced)" : "",
                        valueText(param, param.default_value), cell(rangeText(param)),
                        cell(param.tooltip));
  }
  text += "\n| output | what it holds |\n|---|---|\n";
  for (const grisaille_output_desc& output : effect.outputs()) {
    text += fmt::format("| `{}` | {} |\n", output.key, cell(output.tooltip));
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
