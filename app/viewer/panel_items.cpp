// SPDX-License-Identifier: MIT
// The panel's controls: each reports its place to the layout; names and tooltips are never cut.
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
namespace {

constexpr float kWidestTip = 36;    // font heights
constexpr float kLeastItem = 0.4f;  // of the panel's width, beside its name
constexpr float kLeastPath = 3;     // font heights, beside buttons

}  // namespace

bool Panel::button(const char* label, const char* id, const char* tooltip) {
  const bool pressed = ImGui::Button(label);
  tip(tooltip);
  layout.note(id);
  return pressed;
}

bool Panel::toggle(const char* label, const char* id, bool& value, const char* tooltip) {
  const bool changed = ImGui::Checkbox(label, &value);
  tip(tooltip);
  layout.note(id, value ? "true" : "false");
  return changed;
}

bool Panel::path(const char* label, const char* id, std::string& text,
                 std::initializer_list<const char*> buttons) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float whole = ImGui::GetContentRegionAvail().x;
  float left = whole;
  for (const char* button : buttons) {
    left -= style.ItemSpacing.x + 2 * style.FramePadding.x + ImGui::CalcTextSize(button).x;
  }
  ImGui::SetNextItemWidth(std::clamp(left, kLeastPath * ImGui::GetFontSize(), whole));
  const bool entered = ImGui::InputText(label, &text, ImGuiInputTextFlags_EnterReturnsTrue);
  layout.note(id, text);
  return entered;
}

void Panel::tip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  const float room = ImGui::GetIO().DisplaySize.x - 4 * ImGui::GetStyle().WindowPadding.x;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(std::min(kWidestTip * ImGui::GetFontSize(), room));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  layout.note("tooltip", from.x, from.y, from.x + size.x, from.y + size.y, text);
  ImGui::EndTooltip();
}

std::string Panel::fit(const std::string& name, const std::string& id, float share) {
  const float whole = ImGui::GetContentRegionAvail().x;
  const float left =
      whole - ImGui::CalcTextSize(name.c_str()).x - ImGui::GetStyle().ItemInnerSpacing.x;
  if (left >= kLeastItem * whole) {
    ImGui::SetNextItemWidth(std::min(share * whole, left));
    return name + "###" + id;
  }
  ImGui::TextWrapped("%s", name.c_str());
  layout.note(id + ".name", name);
  ImGui::SetNextItemWidth(whole);
  return "###" + id;
}

std::string Panel::fitted(const std::string& path) {
  const float room = ImGui::GetContentRegionAvail().x;
  for (size_t from = 0; from < path.size(); ++from) {
    if (from > 0 && (static_cast<unsigned char>(path[from]) & 0xc0u) == 0x80u) continue;  // UTF-8
    std::string text = from == 0 ? path : "\u2026" + path.substr(from);
    if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  }
  return path;
}

}  // namespace grisaille::app::viewer
