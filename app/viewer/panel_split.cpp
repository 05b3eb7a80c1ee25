// SPDX-License-Identifier: MIT
// The panel's split of the picture: what the right side shows, on which backend, and how both sides
// are compared.
#include <fmt/format.h>

#include <algorithm>

#include "app/viewer/panel.h"
#include "backends/backends.h"

namespace grisaille::app::viewer {
namespace {

constexpr std::array kWays = {"Line", "Difference", "In turn"};
constexpr std::array kWayIds = {"line", "difference", "flicker"};

// Label of a backend's name; "" stands for the one of the window.
std::string backendLabel(const std::string& name) {
  return name.empty() ? "As the window" : backends::find(name).label;
}

}  // namespace

void Panel::drawRightBackend(const Status& status) {
  std::string& chosen = session_.splitting.backend;
  if (chosen == status.backend) chosen.clear();
  if (ImGui::BeginCombo(fit("Its backend", "right backend").c_str(),
                        backendLabel(chosen).c_str())) {
    std::vector<std::string> names = {""};
    for (const backends::Backend& one : backends::all()) names.emplace_back(one.name);
    for (const std::string& name : names) {
      if (name == status.backend) continue;
      if (ImGui::Selectable(backendLabel(name).c_str(), name == chosen)) chosen = name;
      layout.note("right backend." + (name.empty() ? "window" : name));
    }
    ImGui::EndCombo();
  }
  layout.note("right backend", chosen);
  tip("Renders the right side on another backend as well, to compare the two");
}

void Panel::drawSplitWay() {
  SplitSettings& split = session_.splitting;
  const auto now = static_cast<size_t>(split.way);
  if (ImGui::BeginCombo(fit("Compare by", "split way").c_str(), kWays[now])) {
    for (size_t i = 0; i < kWays.size(); ++i) {
      if (ImGui::Selectable(kWays[i], i == now)) split.way = static_cast<SplitWay>(i);
      layout.note(std::string("split way.") + kWayIds[i]);
    }
    ImGui::EndCombo();
  }
  layout.note("split way", kWayIds[static_cast<size_t>(split.way)]);
  tip("A line between the sides, the difference of their colours, or one side after the other "
      "(Shift+X)");
  if (split.way == SplitWay::kDifference) {
    ImGui::SliderFloat(fit("Full colour at", "split full").c_str(), &split.full,
                       SplitSettings::kLeastFull, SplitSettings::kMostFull, "%.4g",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    layout.note("split full", fmt::format("{}", split.full));
    tip("The difference of two colours, 0 to 1, that has the full blue or orange");
  } else if (split.way == SplitWay::kFlicker) {
    ImGui::SliderScalar(fit("Each side for", "split turn").c_str(), ImGuiDataType_Double,
                        &split.turn, &SplitSettings::kLeastTurn, &SplitSettings::kMostTurn,
                        "%.2f s", ImGuiSliderFlags_AlwaysClamp);
    layout.note("split turn", fmt::format("{}", split.turn));
  }
}

void Panel::drawSplit(const Status& status) {
  toggle("Split", "split", session_.split, "Compares two sides of the picture, A and B (X)");
  if (!session_.split) return;
  drawViewChoice("Right side", "view right", session_.right, session_.views(true));
  if (button("Hold", "hold", "Keeps the current settings for the right side")) session_.hold();
  if (session_.held) {
    ImGui::SameLine();
    if (button("Swap", "swap", "Exchanges the settings of both sides")) session_.swapHeld();
    ImGui::SameLine();
    if (button("Let go", "let go", "Shows the live settings on the right side again")) {
      session_.held.reset();
      session_.checkViews();
    }
  }
  drawRightBackend(status);
  drawSplitWay();
}

}  // namespace grisaille::app::viewer
