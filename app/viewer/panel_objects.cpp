// SPDX-License-Identifier: MIT
// The panel's objects: controls and lists, built from the effects' tables of objects.
#include <fmt/format.h>
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/color_space.hpp>
#include <utility>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
namespace {

constexpr float kListLines = 6;  // height of the list of objects, at most

std::string tooltipOf(const objects::Field& field) {
  std::string text = fmt::format("{}\n{}", field.tooltip, field.key);
  if (field.type == GRISAILLE_FIELD_NUMBER) {
    text += fmt::format(": {:g} to {:g}{}{}", field.min, field.max, *field.unit != '\0' ? " " : "",
                        field.unit);
  }
  return text;
}

// The object's line in the list: its index, its texts, the names of its files, its point.
std::string nameOf(const objects::ObjectList& list, size_t index) {
  const objects::Table& table = list.table();
  std::string name = fmt::format("{}", index);
  for (const objects::Field& field : objects::fieldsOf(table)) {
    const std::string text = list.view().value(index, field).text;
    if (text.empty()) continue;
    const bool file = field.type == GRISAILLE_FIELD_FILE;
    name += "  " + (file ? std::filesystem::path(text).filename().string() : text);
  }
  const auto at = list.view().value(index, table.fields[table.point_field]).numbers;
  return name + fmt::format("  ({:.2f}, {:.2f}, {:.2f})", at[0], at[1], at[2]);
}

bool editColour(const char* label, std::array<double, 3>& linear) {
  const glm::vec3 before(static_cast<float>(linear[0]), static_cast<float>(linear[1]),
                         static_cast<float>(linear[2]));
  glm::vec3 encoded = glm::convertLinearToSRGB(before);
  if (!ImGui::ColorEdit3(label, &encoded.x,
                         ImGuiColorEditFlags_PickerHueWheel | ImGuiColorEditFlags_DisplayHex)) {
    return false;
  }
  const glm::vec3 after = glm::convertSRGBToLinear(glm::clamp(encoded, 0.0f, 1.0f));
  linear = {after.x, after.y, after.z};
  return true;
}

}  // namespace

void Panel::drawObjects(const Status& status) {
  const std::vector<std::string> effects = session_.effectsWithObjects();
  drafting_ = false;
  if (effects.empty()) ImGui::TextDisabled("No effect that is on has objects.");
  for (const std::string& effect : effects) {
    ImGui::PushID(effect.c_str());
    drawObjectsOf(effect, status);
    ImGui::PopID();
  }
  if (draft_ && !drafting_) takeDraft();
  if (!findOwned(session_.chain.selection.effects())) return;
  wantsCoverage = ImGui::TreeNodeEx("Coverage", ImGuiTreeNodeFlags_NoTreePushOnOpen);
  layout.note("coverage", wantsCoverage ? "open" : "closed");
  if (wantsCoverage) drawCoverage(status);
}

void Panel::drawObjectsOf(const std::string& effect, const Status& status) {
  const objects::ObjectList& list = session_.listOf(effect);
  const objects::Table& table = list.table();
  ImGui::Text("%s: %zu", table.label, list.size());
  tip(table.tooltip);
  layout.note(effect + ".objects", fmt::format("{}", list.size()));
  const auto count = [&](uint64_t objects, const char* what, const char* tooltip, const char* key) {
    if (objects == 0) return;
    ImGui::SameLine();
    ImGui::TextDisabled("%llu %s", static_cast<unsigned long long>(objects), what);
    tip(tooltip);
    layout.note(effect + key, fmt::format("{}", objects));
  };
  count(status.waiting, "waiting", "Objects that follow in the next frames", ".waiting");
  count(status.givenUp, "given up",
        "The oldest objects are not drawn: the memory that their effect may use is full. Raise its "
        "Memory, or undo",
        ".given_up");
  count(status.coarser, "coarser",
        "Old objects are drawn with coarser edges: the memory that their effect may use is nearly "
        "full. Raise its Memory, or undo",
        ".coarser");
  ImGui::SameLine();
  if (ImGui::SmallButton("Clear")) session_.clearObjects(effect);
  tip("Deletes all objects; Ctrl+Z restores them");
  layout.note(effect + ".clear");
  bool placing = session_.placing && session_.placer() == effect;
  const char* tip = table.placement == GRISAILLE_PLACE_RAY
                        ? "Click through a pixel to place an object, hold to spray. Off: orbits (B)"
                        : "Click on a surface to place an object. Off: orbits (B)";
  if (toggle("Left button places", (effect + ".placing").c_str(), placing, tip)) {
    session_.placeWith(effect, placing);
  }
  ImGui::Indent();
  objects::Object& next = session_.nextObject(effect);
  for (size_t i = 0; i < next.values.size(); ++i) {
    if (i == table.point_field || i == table.direction_field) continue;
    editField(table.fields[i], effect + ".next.", next.values[i]);
  }
  ImGui::Unindent();
  drawObjectList(effect);
  drawObjectFile(effect);
}

void Panel::drawObjectFile(const std::string& effect) {
  std::string& file = objectPaths_.try_emplace(effect, effect + ".json").first->second;
  path("##objects", (effect + ".path").c_str(), file, {"Load", "Save"});
  ImGui::SameLine();
  if (button("Load", (effect + ".load").c_str())) {
    session_.attempt(effect + " to load", [&] { session_.loadObjects(effect, file); });
  }
  ImGui::SameLine();
  if (button("Save", (effect + ".save").c_str())) {
    session_.attempt(effect + " to save", [&] { session_.saveObjects(effect, file); });
  }
}

void Panel::drawObjectList(const std::string& effect) {
  const bool open = ImGui::TreeNodeEx("list", ImGuiTreeNodeFlags_NoTreePushOnOpen, "List");
  layout.note(effect + ".list", open ? "open" : "closed");
  const objects::ObjectList& list = session_.listOf(effect);
  if (!open || list.size() == 0) return;
  const auto now = session_.chosen();
  std::optional<size_t> chosen;
  if (now && now->effect == effect) chosen = now->index;
  const bool fresh = std::exchange(chosenBefore_[effect], chosen) != chosen;
  const float lines = std::min(kListLines, static_cast<float>(list.size()));
  ImGui::BeginChild("objects", ImVec2(0, lines * ImGui::GetTextLineHeightWithSpacing()));
  ImGuiListClipper clipper;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  if (chosen && fresh) ImGui::SetScrollY((static_cast<float>(*chosen) - lines / 2) * line);
  clipper.Begin(static_cast<int>(list.size()));
  while (clipper.Step()) {
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const auto index = static_cast<size_t>(row);
      ImGui::PushID(row);
      if (ImGui::Selectable("##row", chosen == index)) {
        chosen = chosenBefore_[effect] = index;
        session_.choose(effect, index);
      }
      layout.note(fmt::format("{}.object.{}", effect, index), chosen == index ? "true" : "false");
      const std::string name = nameOf(list, index);
      tip(name);
      ImGui::SameLine(0, 0);
      ImGui::TextUnformatted(name.c_str());
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (chosen) drawSelected(effect, *chosen);
}

void Panel::drawSelected(const std::string& effect, size_t index) {
  const objects::Table& table = session_.listOf(effect).table();
  objects::Object object = session_.listOf(effect).object(index);
  ImGui::Indent();
  for (size_t i = 0; i < object.values.size(); ++i) {
    const objects::Field& field = table.fields[i];
    const std::string id = effect + ".field.";
    if (objects::isText(field)) {
      draftText(field, id, {effect, index, i, object.values[i].text});
      continue;
    }
    const bool edited = editField(field, id, object.values[i]);
    const std::string name = fmt::format("{}{}.{}", id, index, field.key);
    if (edited) {
      session_.attempt(name, [&] {
        session_.changeObjects(effect, fmt::format("{}[{}].{}", table.key, index, field.key),
                               editing_ == name,
                               [&](objects::ObjectList& list) { list.set(index, object); });
      });
      editing_ = name;
    } else if (editing_ == name && !ImGui::IsItemActive()) {
      editing_.clear();
    }
  }
  if (button("Earlier", (effect + ".earlier").c_str()) && index > 0) {
    session_.reorderChosen(index - 1);
  }
  ImGui::SameLine();
  if (button("Later", (effect + ".later").c_str())) session_.reorderChosen(index + 1);
  ImGui::SameLine();
  if (button("Delete", (effect + ".delete").c_str(), "(Delete)")) session_.deleteChosen();
  ImGui::Unindent();
}

// Keeps the text of a selected object as a draft until the user leaves the control: part of a path
// would name another file or none.
void Panel::draftText(const objects::Field& field, const std::string& id, Draft draft) {
  const bool before = draft_ && draft_->effect == draft.effect && draft_->index == draft.index &&
                      draft_->field == draft.field;
  objects::Value value{.numbers = {}, .text = before ? draft_->text : draft.text};
  const bool edited = editField(field, id, value);
  if (!edited && !before) return;
  drafting_ = drafting_ || ImGui::IsItemActive();
  draft.text = value.text;
  draft_ = std::move(draft);
}

void Panel::takeDraft() {
  const Draft draft = *std::exchange(draft_, std::nullopt);
  session_.attempt(draft.effect + " text", [&] {
    const objects::Table& table = session_.listOf(draft.effect).table();
    const std::string what =
        fmt::format("{}[{}].{}", table.key, draft.index, table.fields[draft.field].key);
    session_.changeObjects(draft.effect, what, false, [&](objects::ObjectList& list) {
      if (draft.index >= list.size()) return;
      objects::Object object = list.object(draft.index);
      object.values[draft.field].text = draft.text;
      list.set(draft.index, object);
    });
  });
}

// Draws the control of one field; true if the user changed `value`.
bool Panel::editField(const objects::Field& field, const std::string& id, objects::Value& value) {
  const std::string label = fit(field.label, id + field.key);
  bool edited = false;
  switch (field.type) {
    case GRISAILLE_FIELD_COLOUR:
      edited = editColour(label.c_str(), value.numbers);
      break;
    case GRISAILLE_FIELD_NUMBER: {
      const double range = field.max - field.min;
      const auto speed = static_cast<float>(
          std::min(range / 500, std::max(1e-3, std::abs(value.numbers[0]) / 100)));
      const std::string format =
          *field.unit != '\0' ? fmt::format("%.5g {}", field.unit) : std::string("%.5g");
      edited =
          ImGui::DragScalar(label.c_str(), ImGuiDataType_Double, value.numbers.data(), speed,
                            &field.min, &field.max, format.c_str(), ImGuiSliderFlags_AlwaysClamp);
      break;
    }
    case GRISAILLE_FIELD_TEXT:
    case GRISAILLE_FIELD_FILE:
      edited = ImGui::InputText(label.c_str(), &value.text);
      break;
    default: {
      const double step = 0.01;  // metres; for a direction, a share of its length
      edited = ImGui::DragScalarN(label.c_str(), ImGuiDataType_Double, value.numbers.data(), 3,
                                  static_cast<float>(step), nullptr, nullptr, "%.3f");
    }
  }
  tip(tooltipOf(field));
  layout.note(id + field.key, objects::textOf(field, value));
  return edited;
}

void Panel::drawCoverage(const Status& status) {
  for (const ColorShare& share : status.coverage) {
    unsigned bits = 0x808080;
    if (share.color.size() == 7)
      bits = static_cast<unsigned>(std::stoul(share.color.substr(1), nullptr, 16));
    const auto channel = [&](int shift) { return static_cast<float>(bits >> shift & 255u) / 255; };
    ImGui::ColorButton(share.color.c_str(), ImVec4(channel(16), channel(8), channel(0), 1),
                       ImGuiColorEditFlags_NoTooltip);
    ImGui::SameLine();
    ImGui::Text("%s  %.2f %%", share.color.c_str(), 100 * share.share);
    layout.note("coverage." + share.color, fmt::format("{:.6f}", share.share));
  }
}

}  // namespace grisaille::app::viewer
