// SPDX-License-Identifier: MIT
// The panel's comparison with truth.
#include <fmt/format.h>

#include <algorithm>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
void Panel::drawTruthSettings() {
  const std::vector<std::string> outputs = session_.comparable();
  const std::string compared = session_.comparedOutput();
  if (outputs.size() > 1) {
    if (ImGui::BeginCombo(fit("Compared", "compared").c_str(), compared.c_str())) {
      for (const std::string& output : outputs) {
        if (ImGui::Selectable(output.c_str(), output == compared)) {
          session_.comparing.output = output;
        }
        layout.note("compared." + output);
      }
      ImGui::EndCombo();
    }
    layout.note("compared", compared);
  }
  double radius = session_.truthRadius();
  if (ImGui::InputDouble(fit("Truth's radius, m", "truth radius").c_str(), &radius, 0, 0, "%.6g",
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
    session_.attempt("truth's radius", [&] { session_.setTruthRadius(radius); });
  }
  tip("Length of the rays. Right click: the effect's radius");
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) session_.comparing.radius.reset();
  layout.note("truth radius", fmt::format("{}", session_.truthRadius()));
  int rays = static_cast<int>(session_.comparing.rays);
  ImGui::SliderInt(fit("Truth's rays per pixel", "truth rays").c_str(), &rays,
                   TruthSettings::kLeastRays, TruthSettings::kMostRays, "%d",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  session_.comparing.rays = static_cast<uint32_t>(rays);
  layout.note("truth rays", fmt::format("{}", rays));
}

void Panel::drawTruth() {
  bool on = session_.comparing.on;
  if (toggle("Compare with truth", "compare", on,
             "Traces the view in the background and shows the error (T)")) {
    session_.compareWithTruth(on);
  }
  if (session_.comparedOutput().empty()) {
    if (on) ImGui::TextDisabled("No effect that is on has a visibility output.");
    return;
  }
  drawTruthSettings();
  ImGui::Separator();
}

}  // namespace grisaille::app::viewer
