// SPDX-License-Identifier: MIT
// The panel's comparison with truth.
#include <fmt/format.h>

#include <algorithm>

#include "app/truth/error_map.h"
#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
namespace {

// The error map's colours with their values.
void drawLegend() {
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = 0.6f * ImGui::GetTextLineHeight();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const auto colorAt = [](float error) {
    const glm::vec3 color = truth::errorColor(error);
    return ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, 1));
  };
  const ImU32 dark = colorAt(-truth::kFullError), bright = colorAt(truth::kFullError);
  const ImU32 right = colorAt(0);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = from.x + width / 2;
  list.AddRectFilledMultiColor(from, ImVec2(middle, from.y + height), dark, right, right, dark);
  list.AddRectFilledMultiColor(ImVec2(middle, from.y), ImVec2(from.x + width, from.y + height),
                               right, bright, bright, right);
  ImGui::Dummy(ImVec2(width, height));
  const std::string darkText = fmt::format("-{:.2f} too dark", truth::kFullError);
  const std::string brightText = fmt::format("too bright +{:.2f}", truth::kFullError);
  ImGui::TextUnformatted(darkText.c_str());
  ImGui::SameLine(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(brightText.c_str()).x);
  ImGui::TextUnformatted(brightText.c_str());
}

void drawNumbers(const TruthStatus& status) {
  const truth::Comparison& c = status.comparison;
  if (c.pixels == 0) {
    ImGui::TextDisabled(status.running ? "preparing the scene for tracing" : "nothing is traced");
    return;
  }
  ImGui::Text("RMSE %.4f \u00b1 %.1g, mean error %+.4f", c.rmse, c.error, c.bias);
  ImGui::Text("truth \u00b1%.3f per pixel, %.0f rays, %.3g %% of pixels%s", c.noise, status.rays,
              100 * status.share, status.running ? " \u2026" : "");
}

}  // namespace

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

void Panel::drawTruth(const TruthStatus& status) {
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
  drawNumbers(status);
  if (session_.left == kErrorView || (session_.split && session_.right == kErrorView)) {
    drawLegend();
  }
  if (const auto& point = status.cursor) {
    ImGui::Text("here %.3f, truth %.3f \u00b1 %.3f, error %+.3f", point->shown, point->truth,
                point->truthError, point->shown - point->truth);
  } else {
    ImGui::TextDisabled("here: nothing under the cursor");
  }
  ImGui::Separator();
}

}  // namespace grisaille::app::viewer
