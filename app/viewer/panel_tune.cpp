// SPDX-License-Identifier: MIT
// The panel's presets, and its controls for `grisaille tune`.
#include <fmt/format.h>

#include <algorithm>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
namespace {

void drawTrouble(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, errorColour());
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void drawQuiet(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

// Words after a comma begin a new line if they do not fit. ImGui's own wrapping would also cut
// numbers at their point.
void drawQuietPieces(const std::string& text) {
  const float gap = ImGui::CalcTextSize(" ").x;
  for (size_t from = 0; from < text.size();) {
    const size_t comma = text.find(", ", from);
    const size_t end = comma == std::string::npos ? text.size() : comma + 1;
    const std::string piece = text.substr(from, end - from);
    const float width = ImGui::CalcTextSize(piece.c_str()).x;
    if (from > 0) {
      ImGui::SameLine(0, gap);
      if (width > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    }
    if (width > ImGui::GetContentRegionAvail().x) {
      drawQuiet(piece);
    } else {
      ImGui::TextDisabled("%s", piece.c_str());
    }
    from = end + 1;
  }
}

std::string tooltipOf(const Preset& preset, const Presets& presets) {
  std::string values;
  for (const auto& [key, text] : preset.values) {
    values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", key, text);
  }
  return fmt::format("{}\n{}\nmeasured: {}", priceOf(preset), values, presets.study);
}

}  // namespace

void Panel::drawPresets(effect::Selection::Entry& entry) {
  const std::string key = entry.key();
  const EffectPresets& own = session_.presetsOf(key);
  if (!own.error.empty()) {
    drawTrouble(own.error);
    layout.note(key + ".presets", own.error);
  }
  if (own.presets.all.empty()) return;
  const Preset* const now = presetOf(entry.values, own.presets);
  if (now != nullptr) {
    drawQuietPieces(fmt::format("Preset: {}, {}", now->name, priceOf(*now)));
  } else {
    drawQuiet("Preset: custom; error and cost of the others:");
  }
  layout.note(key + ".presets", now != nullptr ? now->name : "custom");
  // Tight, so that one row holds the usual five.
  const ImVec2 padding(ImGui::GetStyle().FramePadding.x / 4, ImGui::GetStyle().FramePadding.y);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x / 2;
  const float room = ImGui::GetContentRegionAvail().x;
  float widest = 0;
  for (const Preset& preset : own.presets.all) {
    widest = std::max(widest, ImGui::CalcTextSize(preset.name.c_str()).x + 2 * padding.x);
  }
  // As many in a row as the longest name allows.
  const size_t columns = std::clamp(static_cast<size_t>((room + gap) / (widest + gap)), size_t{1},
                                    own.presets.all.size());
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
  const auto count = static_cast<float>(columns);
  const float width = (room - (count - 1) * gap) / count;
  const float height = 3 * ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().FramePadding.y;
  std::string chosen;
  for (const Preset& preset : own.presets.all) {
    const auto index = static_cast<size_t>(&preset - own.presets.all.data());
    if (index % columns != 0) ImGui::SameLine(0, gap);
    const bool is = &preset == now;
    if (is) {
      ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
      ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_WHITE);  // on the accent, in both themes
    }
    const std::string label =
        fmt::format("{}\n{:.3f}\n{:.2f} x", preset.name, preset.error, preset.cost);
    if (ImGui::Button(label.c_str(), ImVec2(width, height))) chosen = preset.name;
    if (is) ImGui::PopStyleColor(2);
    tip(tooltipOf(preset, own.presets));
    layout.note(key + ".preset." + preset.name, is ? "true" : "false");
  }
  ImGui::PopStyleVar();
  if (!chosen.empty()) session_.attempt("preset", [&] { session_.choosePreset(entry, chosen); });
}

// The effect's last request; at first, the error bound is that of the preset "balanced".
TuneWish& Panel::wishOf(const std::string& effect) {
  const auto [found, fresh] = wishes_.try_emplace(effect);
  if (fresh) {
    found->second.effect = effect;
    for (const Preset& preset : session_.presetsOf(effect).presets.all) {
      if (preset.name == "balanced" && preset.error > 0) found->second.maxError = preset.error;
    }
  }
  return found->second;
}

void Panel::drawMayChange(const effect::Selection::Entry& entry, TuneWish& wish) {
  const bool open =
      ImGui::TreeNodeEx("may change", ImGuiTreeNodeFlags_NoTreePushOnOpen, "May change");
  layout.note(wish.effect + ".tune.may change", open ? "open" : "closed");
  if (!open) return;
  const Presets& presets = session_.presetsOf(wish.effect).presets;
  ImGui::Indent();
  for (const grisaille_param_desc* param : tunable(entry.effect(), presets)) {
    const bool fixed = session_.staysInTune(param->key);
    bool may = !fixed && !wish.stay.contains(param->key);
    ImGui::BeginDisabled(fixed);
    const std::string label = fmt::format("{}##may.{}", param->label, param->key);
    if (toggle(label.c_str(), (wish.effect + ".tune.may." + param->key).c_str(), may)) {
      may ? void(wish.stay.erase(param->key)) : void(wish.stay.insert(param->key));
    }
    ImGui::EndDisabled();
    if (fixed) {
      ImGui::SameLine();
      ImGui::TextDisabled("also the truth's radius");
    }
  }
  ImGui::Unindent();
}

void Panel::drawWish(const effect::Selection::Entry& entry, TuneWish& wish) {
  const std::string id = wish.effect + ".tune.";
  const float left = ImGui::GetContentRegionAvail().x * 0.5f;
  const auto field = [&](const char* label, const char* name, const char* format, double& value) {
    const bool budget = std::string_view(name) == "budget";
    if (ImGui::RadioButton(label, wish.byBudget == budget)) wish.byBudget = budget;
    layout.note(id + "by " + name, wish.byBudget == budget ? "true" : "false");
    ImGui::SameLine(left + ImGui::GetStyle().IndentSpacing);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputDouble(fmt::format("##{}", name).c_str(), &value, 0, 0, format)) {
      wish.byBudget = budget;
    }
    layout.note(id + name, fmt::format("{}", value));
  };
  field("Error at most", "error", "%.6g", wish.maxError);
  field("Budget, ms", "budget", "%.6g", wish.budget);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Evaluations at most");
  ImGui::SameLine(left + ImGui::GetStyle().IndentSpacing);
  ImGui::SetNextItemWidth(-1);
  const uint32_t step = 10;
  ImGui::InputScalar("##evaluations", ImGuiDataType_U32, &wish.evaluations, &step);
  wish.evaluations = std::clamp(wish.evaluations, 1u, TuneWish::kMostEvaluations);
  layout.note(id + "evaluations", fmt::format("{}", wish.evaluations));
  drawMayChange(entry, wish);
}

void Panel::drawOutcome(const TuneStatus& status) {
  const TuneRun::Outcome& outcome = status.outcome;
  if (outcome.text.empty()) return;
  if (outcome.values) {
    ImGui::TextWrapped("%s", outcome.text.c_str());
  } else {
    drawTrouble(outcome.text);
  }
  layout.note(status.effect + ".tune.result", outcome.text);
  if (!outcome.warning.empty()) drawTrouble(outcome.warning);
}

void Panel::drawTune(const effect::Selection::Entry& entry, const TuneStatus& status,
                     Requests& requests) {
  const std::string key = entry.key();
  const bool own = status.effect == key;
  if (session_.outputToTune(key).empty() && !(own && status.running)) return;
  const bool open =
      ImGui::TreeNodeEx("tune", ImGuiTreeNodeFlags_NoTreePushOnOpen, "Tune for this view");
  tip("Runs `grisaille tune` in the background: finds the cheapest setting under an error, or the "
      "best setting within a budget");
  layout.note(key + ".tune", open ? "open" : "closed");
  if (!open && !own) return;
  TuneWish& wish = wishOf(key);
  if (open) drawWish(entry, wish);
  if (own && status.running) {
    // The text may wrap, and changes all the time: below the button, which stays where it is.
    ImGui::ProgressBar(static_cast<float>(status.state.done));
    if (button("Cancel", (key + ".tune.cancel").c_str())) requests.cancelTune = true;
    drawQuiet(status.state.text);
    layout.note(key + ".tune.progress", status.state.text);
    return;
  }
  if (open) {
    const double bound = wish.byBudget ? wish.budget : wish.maxError;
    ImGui::BeginDisabled(status.running || !(bound > 0));
    if (button("Tune", (key + ".tune.start").c_str(),
               "One search at a time. The setting that it finds is one step of undo")) {
      requests.tune = wish;
    }
    ImGui::EndDisabled();
  }
  if (own) drawOutcome(status);
}

}  // namespace grisaille::app::viewer
