// SPDX-License-Identifier: MIT
#include "app/viewer/layout.h"

#include <imgui/imgui_internal.h>
#include <nlohmann/json.hpp>

namespace grisaille::app::viewer {

void Layout::note(const std::string& name, const std::string& value) {
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  note(name, from.x, from.y, to.x, to.y, value);
  controls_[name].id = ImGui::GetItemID();
  if (ImGui::IsItemFocused()) note("focus", from.x, from.y, to.x, to.y, name);
}

void Layout::note(const std::string& name, float left, float top, float right, float bottom,
                  const std::string& value) {
  controls_[name] = {.rect = {left, top, right, bottom}, .value = value, .id = 0};
}

std::string Layout::json() const {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, control] : controls_) {
    json[name] = {{"rect", control.rect}, {"value", control.value}};
    if (control.id != 0) json[name]["id"] = control.id;
  }
  return json.dump(1) + "\n";
}

}  // namespace grisaille::app::viewer
