// SPDX-License-Identifier: MIT
#include "app/viewer/panel.h"

#include <fmt/format.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "app/viewer/scene_loading.h"
#include "backends/backends.h"
#include "core/scene/built_in.h"

namespace grisaille::app::viewer {
namespace {

constexpr double kLeastWidth = 12;  // of the panel, in font heights

constexpr struct {
  const char *keys, *what;
} kHelp[] = {
    {"F1", "list all keys"},
    {"F2", "hide or show the panel"},
    {"Tab, arrows, Space, Enter", "move in the panel and use it; Esc leaves it"},
    {"Ctrl + + / - / 0", "larger, smaller, default text"},
    {"", ""},
    {"left drag, arrows", "orbit the surface under the pointer; Shift and drag: through walls"},
    {"middle drag, Shift + scroll / arrows", "pan; on a touchpad: two fingers"},
    {"pinch on a touchpad", "nearer to the pointer, or farther"},
    {"right drag", "look around"},
    {"scroll, Page Up and Down",
     "nearer to the pointer, or farther; with the right button: fly faster, slower"},
    {"double click", "turn to a surface and move to half its distance"},
    {"W A S D, E Q", "fly forward, left, back, right, up, down; Shift: four times as fast"},
    {"F", "the selected object in the middle; again: the whole scene"},
    {"Home", "the scene's own camera"},
    {"Alt + Left, Alt + Right", "previous, next place of the camera"},
    {"1 ... 9", "go to a bookmark; with Ctrl: set it"},
    {"", ""},
    {"B", "left button places an object, or orbits again"},
    {"Space", "place an object in the middle of the picture"},
    {"Ctrl + click, Ctrl + drag", "select an object in the picture; move it along surfaces"},
    {"Delete", "delete the selected object"},
    {"Ctrl + Z, Ctrl + Shift + Z", "undo, redo"},
    {"", ""},
    {"V, Shift + V", "next view, previous view"},
    {"X, Shift + X", "split; compare by a line, by the difference, or in turn"},
    {"[ ]", "move the line left, right"},
    {"T", "compare with truth"},
    {"I", "value under the cursor"},
    {"Ctrl + scroll or pinch, + / -", "zoom into pixels"},
    {"P, N", "pause, one frame"},
    {"K", "play or pause the animation"},
    {", .", "one frame of the animation back, on"},
    {"", ""},
    {"Ctrl + C", "copy the command line"},
    {"Ctrl + O", "open a scene or another file"},
    {"Ctrl + S", "save the settings"},
    {"F5", "look for plugins again"},
    {"F11", "full screen"},
    {"F12", "save the picture"},
    {"Ctrl + Q", "quit"},
};

}  // namespace

float Panel::width(glm::vec2 window) const {
  if (!shown) return 0;
  return std::min(static_cast<float>(state_.layout.panelWidth) * ImGui::GetFontSize(), window.x);
}

// The panel's right border, which the user can drag.
void Panel::drawBorder(glm::vec2 window) {
  const float grip = ImGui::GetStyle().WindowPadding.x;
  ImGui::SetCursorScreenPos(ImVec2(width(window) - grip, grip));
  // The border is outside the part of the window that content may use.
  ImGui::PushClipRect(ImVec2(0, 0), ImVec2(width(window), window.y), false);
  ImGui::InvisibleButton("border", ImVec2(grip, std::max(window.y - 2 * grip, 1.0f)));
  layout.note("panel border");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                              ImGui::GetColorU32(ImGuiCol_SeparatorHovered));
  }
  ImGui::PopClipRect();
  if (!ImGui::IsItemActive()) return;
  const double font = ImGui::GetFontSize();
  const double most = std::max(double{window.x} / font, kLeastWidth);
  const double wanted = (double{ImGui::GetIO().MousePos.x} + double{grip} / 2) / font;
  state_.layout.panelWidth = std::clamp(wanted, kLeastWidth, std::min(most, PanelLayout::kWidest));
}

// A section of the panel. It stays as the user left it, also in the next run.
bool Panel::section(const char* label, bool open) {
  const auto known = state_.layout.sections.find(label);
  ImGui::SetNextItemOpen(known != state_.layout.sections.end() ? known->second : open,
                         known != state_.layout.sections.end() ? ImGuiCond_Always : ImGuiCond_Once);
  const bool is = ImGui::CollapsingHeader(label);
  if (ImGui::IsItemToggledOpen()) state_.layout.sections[label] = is;
  layout.note(std::string("section ") + label, is ? "open" : "closed");
  return is;
}

// The backend of the window, which the user can change, and its device.
void Panel::drawBackend(const Status& status, Requests& requests) {
  const float combo = 6 * ImGui::GetFontSize();
  ImGui::SetNextItemWidth(std::min(combo, ImGui::GetContentRegionAvail().x));
  const std::string now = status.backend.empty() ? "" : backends::find(status.backend).label;
  if (ImGui::BeginCombo("###backend", now.c_str())) {
    for (const backends::Backend& one : backends::all()) {
      if (ImGui::Selectable(one.label, one.name == status.backend)) requests.backend = one.name;
      layout.note(std::string("backend.") + one.name);
    }
    ImGui::EndCombo();
  }
  layout.note("backend", status.backend);
  tip("Opens the window with another backend; everything stays as it is");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  const std::string device = status.device.name + (status.device.software ? ", software" : "");
  ImGui::TextWrapped("%s", device.c_str());
}

Requests Panel::draw(const Status& status, glm::vec2 window) {
  Requests requests;
  layout.begin();
  if (!listsFresh_) {
    bookmarkList_ = bookmarks_.list();
    savedList_ = savedSettings();
    listsFresh_ = true;
  }
  if (shown) {
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(ImVec2(width(window), window.y));
    ImGui::Begin("Grisaille", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing);
    drawBackend(status, requests);
    const float below = heightBelow(status, window);
    if (std::exchange(wantsFocus_, false)) ImGui::SetNextWindowFocus();
    ImGui::BeginChild("controls", ImVec2(0, -below));
    if (session_.hasAnimations() && section("Time", true)) drawTime();
    if (section("Effects", true)) drawEffects(status, requests);
    if (section("View", true)) drawViews(status, requests);
    wantsCoverage = false;
    if (section("Objects", !session_.effectsWithObjects().empty())) drawObjects(status);
    if (section("Settings", false)) drawSettings(requests);
    if (section("Cost", false)) drawCost(status);
    if (section("Camera", false)) drawCamera();
    if (section("Sequence", false)) drawSequence(status, requests);
    if (section("Scene", false)) drawScene(requests);
    ImGui::EndChild();
    drawReadout(status);
    drawMessages();
    drawBorder(window);
    ImGui::End();
  }
  drawLoading(status, window, requests);
  drawFailure(status, window, requests);
  if (const auto file = dialog_.draw(state_, width(window), window.x, window.y, layout)) {
    requests.file = file;
  }
  if (help) drawHelp(window);
  return requests;
}

void Panel::drawSettings(Requests& requests) {
  ImGui::BeginDisabled(!session_.history.canUndo());
  if (button("Undo", "undo", session_.history.undoName().c_str())) session_.undo();
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!session_.history.canRedo());
  if (button("Redo", "redo", session_.history.redoName().c_str())) session_.redo();
  ImGui::EndDisabled();
  path("##settings", "settings path", settingsPath_, {"Load", "Save"});
  ImGui::SameLine();
  if (button("Load", "load settings")) {
    session_.attempt("settings to load", [&] { session_.loadSettings(settingsPath_); });
  }
  ImGui::SameLine();
  if (button("Save", "save settings", "(Ctrl+S)")) saveSettings();
  for (const SavedSettings& saved : savedList_) {
    if (ImGui::Selectable(saved.name.c_str())) {
      session_.attempt("settings to load", [&] { session_.loadSettings(saved.path.string()); });
    }
    layout.note("saved." + saved.name);
  }
  path("##saved", "saved name", savedName_, {"Save as"});
  ImGui::SameLine();
  if (button("Save as", "save named", "Lists the settings under this name, in every session")) {
    session_.attempt("settings to save", [&] {
      Bookmarks::checkName(savedName_);
      std::filesystem::create_directories(configFolder() / "settings");
      session_.saveSettings((configFolder() / "settings" / (savedName_ + ".toml")).string());
    });
    listsFresh_ = false;
  }
  toggle("Light theme", "light theme", state_.layout.light);
  path("##session", "session path", sessionPath_, {"Open", "Save session"});
  ImGui::SameLine();
  if (button("Open##session", "open session",
             "Scene, camera, effects, values, objects and layout of a session file")) {
    requests.openSession = sessionPath_;
  }
  ImGui::SameLine();
  if (button("Save session", "save session",
             "One file with all that you have set; the last session comes back by itself")) {
    requests.saveSession = sessionPath_;
  }
  if (button("Copy as command line", "copy command",
             "Copies the `grisaille render` command that makes this picture (Ctrl+C)")) {
    requests.copyCommand = true;
  }
}

void Panel::drawCamera() {
  scene::Camera edited = session_.camera;
  bool changed = false;
  const auto field = [&](const char* label, glm::dvec3& value) {
    changed |=
        ImGui::InputScalarN(fit(label, label, 0.75f).c_str(), ImGuiDataType_Double, &value.x, 3,
                            nullptr, nullptr, "%.4f", ImGuiInputTextFlags_EnterReturnsTrue);
    layout.note(std::string("camera.") + label);
  };
  field("Eye", edited.eye);
  field("Target", edited.target);
  const double least = 5, most = 120;
  changed |= ImGui::SliderScalar(fit("Field of view", "fov").c_str(), ImGuiDataType_Double,
                                 &edited.fovyDegrees, &least, &most, "%.1f degrees");
  layout.note("camera.fov", fmt::format("{}", edited.fovyDegrees));
  if (changed) {
    session_.attempt("camera", [&] {
      scene::validate(edited);
      session_.camera = edited;
    });
  }
  ImGui::Text("Flying speed x %.3g", session_.speed);
  for (const Bookmarks::Entry& entry : bookmarkList_) {
    ImGui::PushID(entry.name.c_str());
    if (ImGui::SmallButton("x")) {
      session_.attempt("bookmark", [&] { bookmarks_.remove(entry.name); });
      listsFresh_ = false;
    }
    ImGui::SameLine();
    if (!entry.camera) {
      ImGui::TextColored(errorColour(), "%s: %s", entry.name.c_str(), entry.error.c_str());
    } else if (ImGui::Selectable(entry.name.c_str())) {
      session_.goTo(*entry.camera);
    }
    layout.note("bookmark." + entry.name);
    ImGui::PopID();
  }
  path("##bookmark", "bookmark name", bookmarkName_, {"Bookmark"});
  ImGui::SameLine();
  if (button("Bookmark", "save bookmark")) {
    session_.attempt("bookmark", [&] { bookmarks_.save(bookmarkName_, session_.camera); });
    listsFresh_ = false;
  }
}

void Panel::drawHelp(glm::vec2 window) {
  ImGui::SetNextWindowPos(ImVec2((width(window) + window.x) / 2, window.y / 2), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(window.x, window.y));
  ImGui::Begin("Keys (F1)", &help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
  if (ImGui::BeginTable("keys", 2)) {
    for (const auto& line : kHelp) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(line.keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(line.what);
    }
    ImGui::EndTable();
  }
  layout.note("help");
  ImGui::End();
}

}  // namespace grisaille::app::viewer
