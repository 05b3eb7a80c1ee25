// SPDX-License-Identifier: MIT
// The panel's views.
#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/color_space.hpp>

#include "app/settings/background.h"
#include "app/viewer/panel.h"

namespace grisaille::app::viewer {

void Panel::drawViewChoice(const char* label, const char* id, std::string& output,
                           const std::vector<Viewable>& all) {
  const auto now = std::ranges::find(all, output, &Viewable::output);
  if (ImGui::BeginCombo(fit(label, id).c_str(),
                        now != all.end() ? now->label.c_str() : output.c_str())) {
    for (const Viewable& one : all) {
      if (ImGui::Selectable(one.label.c_str(), one.output == output)) output = one.output;
      layout.note(std::string(id) + "." + one.output);
    }
    ImGui::EndCombo();
  }
  layout.note(id, output);
}

void Panel::drawBackground() {
  bool transparent = session_.background.a == 0;
  glm::vec3 colour = glm::convertLinearToSRGB(glm::vec3(session_.background));
  ImGui::BeginDisabled(transparent);
  if (ImGui::ColorEdit3("Background", &colour.x, ImGuiColorEditFlags_NoInputs)) {
    session_.background = frame::Background(glm::convertSRGBToLinear(colour), 1);
  }
  ImGui::EndDisabled();
  layout.note("background", textOf(session_.background));
  ImGui::SameLine();
  if (toggle("Transparent", "transparent", transparent,
             "Saved pictures have an alpha channel: 0 where there is no surface")) {
    session_.background = transparent ? frame::kTransparent : frame::kGrey;
  }
}

void Panel::drawFineness(const Status& status) {
  Fineness& fineness = session_.fineness;
  toggle("Half resolution while it moves", "halves", fineness.halves,
         fmt::format("Only where a frame takes over {:.0f} ms; sharp again once it rests",
                     1000 * Fineness::kSlowFrame)
             .c_str());
  toggle("Converge while it rests", "converges", fineness.converges,
         "Averages as many frames as effects with a History can, whatever its value. Off: as many "
         "as the value says");
  if (status.toAverage <= 1) return;
  ImGui::TextDisabled("%u of %u frames averaged", std::min(status.averaged, status.toAverage),
                      status.toAverage);
  layout.note("averaged", fmt::format("{}", std::min(status.averaged, status.toAverage)));
}

void Panel::drawViews(const Status& status, Requests& requests) {
  drawViewChoice("View", "view", session_.left, session_.views(false));
  drawSplit(status);
  drawTruth();
  bool base = session_.surface == frame::Surface::kBaseColour;
  if (toggle("Base colour under the light", "base", base, "Off: all surfaces are white")) {
    session_.surface = base ? frame::Surface::kBaseColour : frame::Surface::kWhite;
  }
  drawBackground();
  ImGui::SliderFloat(fit("Zoom", "zoom").c_str(), &session_.zoom, 1, 64, "%.3g px per texel",
                     ImGuiSliderFlags_Logarithmic);
  layout.note("zoom", fmt::format("{}", session_.zoom));
  toggle("Value under the cursor", "inspect", session_.inspecting,
         "Shown at the bottom of the panel; of both sides, if the picture is split (I)");
  drawFineness(status);
  toggle("Pause", "pause", session_.paused, "Keeps the picture as it is (P)");
  ImGui::SameLine();
  if (button("Step", "step", "Renders one frame (N)")) session_.step = true;

  ImGui::Separator();
  toggle("Picture as large as on the screen", "as shown", pictureAsShown);
  if (!pictureAsShown) {
    int size[2] = {static_cast<int>(pictureSize.x), static_cast<int>(pictureSize.y)};
    if (ImGui::InputInt2(fit("Size, px", "picture size").c_str(), size)) {
      pictureSize = glm::uvec2(glm::clamp(glm::ivec2(size[0], size[1]), 1, 16384));
    }
    layout.note("picture size");
  }
  if (button("Save picture", "save picture", "A PNG and an EXR in the current folder (F12)")) {
    requests.picture = true;
  }
}

}  // namespace grisaille::app::viewer
