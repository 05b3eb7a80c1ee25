// SPDX-License-Identifier: MIT
#include "app/viewer/axis_widget.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace grisaille::app::viewer {
namespace {

constexpr float kWidgetSize = 5.5f;  // font heights
constexpr float kEndRadius = 0.55f;  // of a circle at an end, font heights
constexpr std::array kNames = {"X", "Y", "Z"};
// Red, green and blue, as light as each other and told apart by their letters.
const std::array<ImVec4, 3> kAxisColours = {
    {{0.93f, 0.42f, 0.40f, 1}, {0.55f, 0.75f, 0.30f, 1}, {0.42f, 0.66f, 0.95f, 1}}};
constexpr double kFacing =
    0.999;                       // cosine to the direction of view from which an end faces the user
constexpr float kFaint = 0.45f;  // of a negative end's colour

struct End {
  size_t axis = 0;
  double sign = 1;
  glm::dvec3 view = glm::dvec3(0);  // right, up, towards the user

  std::string name() const { return std::string(sign > 0 ? "+" : "-") + kNames[axis]; }
};

std::vector<End> endsOf(const scene::Camera& camera) {
  const glm::dmat3 viewFromWorld = glm::transpose(scene::worldFromView(camera));
  std::vector<End> ends;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      ends.push_back({axis, sign, sign * viewFromWorld[static_cast<int>(axis)]});
    }
  }
  std::ranges::sort(ends, {}, [](const End& end) { return end.view.z; });
  return ends;
}

void drawEnd(const End& end, ImVec2 middle, ImVec2 centre, float radius, bool hovered) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImVec4 colour = kAxisColours[end.axis];
  if (end.sign < 0 && !hovered) {
    for (float* part : {&colour.x, &colour.y, &colour.z}) *part *= kFaint;
  }
  const ImU32 packed = ImGui::GetColorU32(colour);
  if (end.sign > 0) list.AddLine(middle, centre, packed, radius / 3);
  list.AddCircleFilled(centre, radius, packed);
  if (end.sign < 0 && !hovered) return;
  const ImVec2 text = ImGui::CalcTextSize(kNames[end.axis]);
  list.AddText(ImVec2(centre.x - text.x / 2, centre.y - text.y / 2), IM_COL32(16, 16, 16, 255),
               kNames[end.axis]);
}

}  // namespace

float axisWidgetSize() {
  return kWidgetSize * ImGui::GetFontSize();
}

std::optional<glm::dvec3> drawAxisWidget(const scene::Camera& camera, glm::vec2 corner,
                                         Layout& layout) {
  const float size = axisWidgetSize(), radius = kEndRadius * ImGui::GetFontSize();
  const float reach = size / 2 - 1.2f * radius;
  const ImVec2 middle(corner.x - size / 2, corner.y + size / 2);
  ImGui::SetNextWindowPos(ImVec2(corner.x - size, corner.y));
  ImGui::SetNextWindowSize(ImVec2(size, size));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::Begin("Axes", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  const std::vector<End> ends = endsOf(camera);
  const auto centreOf = [&](const End& end) {
    return ImVec2(middle.x + reach * static_cast<float>(end.view.x),
                  middle.y - reach * static_cast<float>(end.view.y));
  };
  std::optional<glm::dvec3> clicked;
  const End* hovered = nullptr;
  // The nearest first: of two controls in one place, ImGui takes the one that comes first.
  for (auto end = ends.rbegin(); end != ends.rend(); ++end) {
    const ImVec2 centre = centreOf(*end);
    ImGui::SetCursorScreenPos(ImVec2(centre.x - radius, centre.y - radius));
    if (ImGui::InvisibleButton(end->name().c_str(), ImVec2(2 * radius, 2 * radius))) {
      glm::dvec3 from(0);
      // The end that faces the user hides the other one: it stands for that.
      from[static_cast<int>(end->axis)] = end->view.z > kFacing ? -end->sign : end->sign;
      clicked = from;
    }
    layout.note("axis " + end->name());
    if (!ImGui::IsItemHovered() || hovered != nullptr) continue;
    hovered = &*end;
    ImGui::SetTooltip("Look from %s", end->name().c_str());
  }
  for (const End& end : ends) drawEnd(end, middle, centreOf(end), radius, &end == hovered);
  ImGui::End();
  return clicked;
}

}  // namespace grisaille::app::viewer
