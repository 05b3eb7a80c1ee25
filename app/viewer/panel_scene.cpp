// SPDX-License-Identifier: MIT
// The panel's scene, and the windows beside the panel while one is read or cannot be.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/viewer/panel.h"
#include "app/viewer/scene_loading.h"
#include "core/scene/built_in.h"

namespace grisaille::app::viewer {
namespace {

// Places the next window in the middle of the picture.
void centre(float left, glm::vec2 window) {
  ImGui::SetNextWindowPos(ImVec2((left + window.x) / 2, window.y / 2), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
}

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove;

}  // namespace

void Panel::drawScene(Requests& requests) {
  ImGui::TextWrapped("%s", sceneLabel(session_.scenePath).c_str());
  if (button("Open a file ...", "open dialog",
             "A scene, settings, objects, a camera or a session (Ctrl+O)")) {
    requests.openDialog = true;
  }
  bool open = path("##scene", "scene path", scenePath_, {"Open"});
  ImGui::SameLine();
  open |= button("Open", "open scene",
                 "A .glb or .gltf file, or a built-in scene; or drop a file on the window");
  if (open && !scenePath_.empty()) requests.scene = scenePath_;
  for (const scene::BuiltIn& one : scene::builtIns()) {
    if (ImGui::Selectable(sceneLabel(one.name).c_str())) requests.scene = one.name;
    tip(one.about);
    layout.note(std::string("scene.") + one.name);
  }
  for (const std::string& recent : state_.recent) {
    if (ImGui::Selectable(fitted(recent).c_str())) requests.scene = recent;
    layout.note("recent." + recent);
    tip(recent);
  }
}

void Panel::drawLoading(const Status& status, glm::vec2 window, Requests& requests) {
  if (!status.loading) return;
  centre(width(window), window);
  ImGui::Begin("Loading", nullptr,
               kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  const float room = std::min(20 * ImGui::GetFontSize(), window.x - 2 * ImGui::GetFontSize());
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + room);
  ImGui::TextUnformatted(status.loadingPath.c_str());
  ImGui::PopTextWrapPos();
  ImGui::ProgressBar(static_cast<float>(*status.loading), ImVec2(room, 0));
  layout.note("loading", fmt::format("{:.2f}", *status.loading));
  if (button("Cancel##loading", "cancel loading", "Keeps the scene that is here (Esc)")) {
    requests.cancelLoading = true;
  }
  ImGui::End();
}

// What could not be opened and why, and what to open instead.
void Panel::drawFailure(const Status& status, glm::vec2 window, Requests& requests) {
  if (status.failedScene.empty() || status.loading || dialog_.isShown()) return;
  const float font = ImGui::GetFontSize();
  const float wide = std::min(42 * font, window.x);
  ImGui::SetNextWindowPos(
      ImVec2(std::min((width(window) + window.x) / 2, window.x - wide / 2), window.y / 2),
      ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(wide, std::min(22 * font, window.y)));
  ImGui::Begin("Failure", nullptr, kFixed);
  ImGui::TextUnformatted("The scene is not open");
  ImGui::PushStyleColor(ImGuiCol_Text, errorColour());
  ImGui::TextWrapped("%s", status.failedScene.c_str());
  ImGui::PopStyleColor();
  layout.note("failure", status.failedScene);
  if (button("Open another file ...", "failure open")) requests.openDialog = true;
  ImGui::SameLine();
  if (button("The built-in atrium", "failure atrium")) requests.scene = "atrium";
  if (session_.scene) {
    ImGui::SameLine();
    if (button("Close", "failure close")) requests.closeFailure = true;
  }
  if (!state_.recent.empty()) {
    ImGui::Separator();
    ImGui::TextUnformatted("Opened last:");
    ImGui::BeginChild("recent");
    if (const auto path = drawRecentScenes(state_, thumbnails, "failure recent ", layout)) {
      requests.scene = path;
    }
    ImGui::EndChild();
  }
  ImGui::End();
}

}  // namespace grisaille::app::viewer
