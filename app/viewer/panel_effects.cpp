// SPDX-License-Identifier: MIT
// The panel's effects, and their cost. The effects' tables give all labels, ranges and tooltips.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui/imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/input.h"
#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
namespace {

// A printf format for a value with its unit; escapes '%' in the unit.
std::string formatOf(const grisaille_param_desc& param, const char* number) {
  std::string text = number;
  if (*param.unit == '\0') return text;
  text += ' ';
  for (const char* c = param.unit; *c != '\0'; ++c) text += *c == '%' ? "%%" : std::string(1, *c);
  return text;
}

std::string tooltipOf(const effect::Selection::Entry& entry, const grisaille_param_desc& param) {
  const char* unit = *param.unit != '\0' ? " " : "";
  std::string text = fmt::format("{}\n{}.{}", param.tooltip, entry.key(), param.key);
  if (param.type == GRISAILLE_PARAM_FLOAT || param.type == GRISAILLE_PARAM_INT) {
    text += fmt::format(": {:g} to {:g}{}{}, usually {:g} to {:g}", param.hard_min, param.hard_max,
                        unit, param.unit, param.soft_min, param.soft_max);
  }
  const std::string condition = effect::usedWhenText(entry.effect(), param);
  if (!condition.empty()) text += "\nUsed when " + condition + ".";
  return text + fmt::format("\nCtrl+click: type a value. Right click: back to {}.",
                            effect::textOf(param, entry.values.defaultOf(param.key)));
}

std::string readsOf(const effect::Selection::Entry& entry) {
  try {
    const auto names = effect::readNames(entry.effect(), entry.values.all().data());
    const std::string text = fmt::format("{}", fmt::join(names, ", "));
    return text.empty() ? "nothing" : text;
  } catch (const Error& error) {
    return error.detail();
  }
}

std::string writesOf(const effect::Selection::Entry& entry) {
  std::string text;
  for (const grisaille_output_desc& output : entry.effect().outputs()) {
    text += (text.empty() ? "" : ", ") + std::string(output.key);
  }
  return text;
}

}  // namespace

void Panel::drawEffects(const Status& status, Requests& requests) {
  for (size_t i = 0; i < session_.chain.selection.entries().size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    drawEffect(session_.chain.selection.entries()[i], i, status, requests);
    ImGui::PopID();
  }
  if (button("Rescan plugins", "rescan", "Loads plugins that are new or have changed")) {
    requests.rescan = true;
  }
  if (!status.rebuilding.empty()) ImGui::TextWrapped("building %s ...", status.rebuilding.c_str());
  if (!status.buildMessage.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, errorColour());
    ImGui::TextWrapped("%s", status.buildMessage.c_str());
    ImGui::PopStyleColor();
    layout.note("build message", status.buildMessage);
  }
  for (const effect::Refused& refused : session_.registry().refused()) {
    ImGui::PushStyleColor(ImGuiCol_Text, errorColour());
    ImGui::TextWrapped("%s", refused.reason.what());
    ImGui::PopStyleColor();
    layout.note("refused", refused.reason.what());
  }
}

void Panel::drawEffect(effect::Selection::Entry& entry, size_t index, const Status& status,
                       Requests& requests) {
  const grisaille_effect_desc& desc = *entry.effect().desc;
  const std::string key = desc.key;
  bool on = entry.on;
  if (ImGui::Checkbox("##on", &on)) {
    entry.on = on;
    session_.changed(key + (on ? " on" : " off"));
    session_.checkViews();
  }
  layout.note(key + ".on", on ? "true" : "false");
  ImGui::SameLine();
  const float arrows = 2 * ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - arrows);
  ImGui::SetNextItemOpen(entry.on, ImGuiCond_Once);
  const bool open =
      ImGui::TreeNodeEx(key.c_str(),
                        ImGuiTreeNodeFlags_AllowItemOverlap | ImGuiTreeNodeFlags_SpanAvailWidth |
                            ImGuiTreeNodeFlags_NoTreePushOnOpen,
                        "%s (%s)", desc.label, desc.key);
  tip(fmt::format("{}\nversion {}, {}\nreads {}\nwrites {}", desc.tooltip, desc.version,
                  entry.effect().path, readsOf(entry), writesOf(entry)));
  layout.note(key + ".tree", open ? "open" : "closed");
  const auto leftOut = std::ranges::find(status.leftOut, key, &frame::LeftOut::effect);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - arrows);
  std::optional<size_t> target;
  if (ImGui::ArrowButton("##up", ImGuiDir_Up) && index > 0) target = index - 1;
  layout.note(key + ".up");
  tip("Runs earlier");
  ImGui::SameLine();
  if (ImGui::ArrowButton("##down", ImGuiDir_Down)) target = index + 1;
  layout.note(key + ".down");
  tip("Runs later");
  if (entry.on && leftOut != status.leftOut.end()) {
    ImGui::TextDisabled("off: %s", leftOut->lacks.detail().c_str());
    layout.note(key + ".lacks", leftOut->lacks.detail());
  }
  if (open) {
    ImGui::Indent();
    drawParameters(entry);
    drawTune(entry, status.tune, requests);
    ImGui::Unindent();
  }
  // Last, since `entry` then refers to another effect.
  if (target && *target < session_.chain.selection.entries().size()) {
    session_.chain.selection.move(index, *target);
    session_.changed("order of effects");
  }
}

void Panel::drawParameters(effect::Selection::Entry& entry) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("reads %s; writes %s", readsOf(entry).c_str(), writesOf(entry).c_str());
  ImGui::PopStyleColor();
  drawPresets(entry);
  const auto draw = [&](bool advanced) {
    for (const grisaille_param_desc& param : entry.effect().params()) {
      const bool is = (param.flags & GRISAILLE_PARAM_ADVANCED) != 0;
      if (is == advanced && entry.values.isUsed(param)) drawParameter(entry, param);
    }
  };
  draw(false);
  const bool anyAdvanced =
      std::ranges::any_of(entry.effect().params(), [](const grisaille_param_desc& param) {
        return (param.flags & GRISAILLE_PARAM_ADVANCED) != 0;
      });
  if (anyAdvanced) {
    const bool open =
        ImGui::TreeNodeEx("advanced", ImGuiTreeNodeFlags_NoTreePushOnOpen, "Advanced");
    layout.note(std::string(entry.key()) + ".advanced", open ? "open" : "closed");
    if (open) draw(true);
  }
  drawUnused(entry);
}

// The parameters that do nothing with the present values, folded, each under the reason. They can
// be set all the same.
void Panel::drawUnused(effect::Selection::Entry& entry) {
  std::vector<const grisaille_param_desc*> unused;
  for (const grisaille_param_desc& param : entry.effect().params()) {
    if (!entry.values.isUsed(param)) unused.push_back(&param);
  }
  if (unused.empty()) return;
  const std::string key = entry.key();
  const bool open = ImGui::TreeNodeEx("unused", ImGuiTreeNodeFlags_NoTreePushOnOpen,
                                      "Not in use now: %zu", unused.size());
  tip("Parameters that do nothing with the present values");
  layout.note(key + ".unused", open ? "open" : "closed");
  if (!open) return;
  std::string last;
  for (const grisaille_param_desc* param : unused) {
    const std::string reason = "used when " + effect::usedWhenText(entry.effect(), *param);
    if (reason != last) ImGui::TextDisabled("%s", reason.c_str());
    layout.note(key + "." + param->key + ".reason", 0, 0, 0, 0, reason);
    last = reason;
    drawParameter(entry, *param);
  }
}

void Panel::drawParameter(effect::Selection::Entry& entry, const grisaille_param_desc& param) {
  const std::string name = std::string(entry.key()) + "." + param.key;
  double value = entry.values.get(param.key);
  bool edited = editParameter(entry, param, value);
  // A typed value is applied when the user leaves the text field; Esc drops it.
  if (ImGui::TempInputIsActive(ImGui::GetItemID())) {
    if (edited) typed_ = {name, value};
    edited = false;
  } else if (typed_ && typed_->first == name) {
    edited = !isKeyPressed(GLFW_KEY_ESCAPE);
    value = typed_->second;
    typed_.reset();
  }
  if (ImGui::IsItemHovered()) {
    tip(tooltipOf(entry, param));
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      session_.resetParameter(entry, param.key);
      value = entry.values.get(param.key);
    }
  }
  if (edited && value != entry.values.get(param.key)) {
    session_.attempt(name, [&] {
      entry.values.set(param.key, value);
      session_.changed(name);
    });
  }
  layout.note(name, entry.values.text(param.key));
  if ((param.flags & GRISAILLE_PARAM_SCENE_LENGTH) != 0) drawSceneLength(entry, param);
}

// Under a length of the scene: whether it follows the scene, with a button that takes the table's
// default or follows the scene again.
void Panel::drawSceneLength(effect::Selection::Entry& entry, const grisaille_param_desc& param) {
  const std::string name = std::string(entry.key()) + "." + param.key;
  const std::string scenes = effect::textOf(param, entry.values.defaultOf(param.key));
  const std::string tables = effect::textOf(param, param.default_value);
  const auto choice = [&](const std::string& label, const char* id) {
    return button(fmt::format("{}##{}", label, name).c_str(),
                  fmt::format("{} {}", name, id).c_str());
  };
  if (!entry.values.given(param.key)) {
    if (scenes == tables) return;
    ImGui::AlignTextToFramePadding();  // as the button beside it
    ImGui::TextDisabled("chosen for the scene");
    ImGui::SameLine();
    if (choice(fmt::format("Table's {}", tables), "of the table")) {
      entry.values.set(param.key, param.default_value);
      session_.changed(name);
    }
  } else if (entry.values.text(param.key) != scenes) {
    if (choice(fmt::format("Scene's {}", scenes), "of the scene")) {
      session_.resetParameter(entry, param.key);
    }
  }
}

// Draws the control; true if the user changed `value`.
bool Panel::editParameter(const effect::Selection::Entry& entry, const grisaille_param_desc& param,
                          double& value) {
  const std::string label = fit(param.label, fmt::format("{}.{}", entry.key(), param.key));
  const ImGuiSliderFlags scale =
      (param.flags & GRISAILLE_PARAM_LOG) != 0 ? ImGuiSliderFlags_Logarithmic : 0;
  switch (param.type) {
    case GRISAILLE_PARAM_BOOL: {
      bool on = value != 0;
      const bool edited = ImGui::Checkbox(label.c_str(), &on);
      value = on ? 1 : 0;
      return edited;
    }
    case GRISAILLE_PARAM_ENUM: {
      int index = static_cast<int>(value);
      const bool edited = ImGui::Combo(label.c_str(), &index, param.enum_labels,
                                       static_cast<int>(param.enum_count));
      value = index;
      return edited;
    }
    case GRISAILLE_PARAM_INT: {
      auto whole = static_cast<int64_t>(value);
      const auto least = static_cast<int64_t>(param.soft_min);
      const auto most = static_cast<int64_t>(param.soft_max);
      const bool edited = ImGui::SliderScalar(label.c_str(), ImGuiDataType_S64, &whole, &least,
                                              &most, formatOf(param, "%lld").c_str(), scale);
      value = static_cast<double>(whole);
      return edited;
    }
    default: {
      const bool edited =
          ImGui::SliderScalar(label.c_str(), ImGuiDataType_Double, &value, &param.soft_min,
                              &param.soft_max, formatOf(param, "%.5g").c_str(), scale);
      // A dragged slider snaps to whole steps; a typed value stays exact.
      if (edited && scale == 0 && ImGui::IsMouseDown(ImGuiMouseButton_Left) && param.step > 0) {
        const double steps = std::round((value - param.soft_min) / param.step);
        value = std::clamp(param.soft_min + steps * param.step, param.soft_min, param.soft_max);
      }
      return edited;
    }
  }
}

}  // namespace grisaille::app::viewer
