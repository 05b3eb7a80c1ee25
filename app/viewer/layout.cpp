// SPDX-License-Identifier: MIT
#include "app/viewer/layout.h"

#include <imgui/imgui.h>
#include <nlohmann/json.hpp>

namespace grisaille::app::viewer {

void Layout::note(const std::string& name, const std::string& value) {
  if (!ImGui::IsItemVisible()) return;
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  note(name, from.x, from.y, to.x, to.y, value);
}

void Layout::note(const std::string& name, float left, float top, float right, float bottom,
                  const std::string& value) {
  controls_[name] = {{left, top, right, bottom}, value};
}

std::string Layout::json() const {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, control] : controls_) {
    json[name] = {{"rect", control.rect}, {"value", control.value}};
  }
  return json.dump(1) + "\n";
}

}  // namespace grisaille::app::viewer
