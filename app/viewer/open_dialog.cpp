// SPDX-License-Identifier: MIT
#include "app/viewer/open_dialog.h"

#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

struct Completion {
  const std::string& folder;
  FileKind kind;
};

int completeText(ImGuiInputTextCallbackData* data) {
  const auto& completion = *static_cast<const Completion*>(data->UserData);
  const std::string text(data->Buf, static_cast<size_t>(data->BufTextLen));
  const std::string whole = completed(text, completion.folder, completion.kind);
  data->DeleteChars(0, data->BufTextLen);
  data->InsertChars(0, whole.c_str());
  return 0;
}

}  // namespace

std::optional<std::string> drawRecentScenes(const ViewerState& state, Thumbnails& thumbnails,
                                            const char* prefix, Layout& layout) {
  std::optional<std::string> chosen;
  const ImVec2 size(6 * ImGui::GetFontSize(), 3.375f * ImGui::GetFontSize());
  const float pad = ImGui::GetStyle().FramePadding.x, right = ImGui::GetContentRegionMax().x;
  for (size_t i = 0; i < state.recent.size(); ++i) {
    const std::string& path = state.recent[i];
    ImGui::PushID(path.c_str());
    if (i > 0) {
      ImGui::SameLine();
      if (ImGui::GetCursorPosX() + size.x + 2 * pad > right) ImGui::NewLine();
    }
    ImGui::BeginGroup();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    if (ImGui::Button("##recent", ImVec2(size.x + 2 * pad, size.y + 2 * pad))) chosen = path;
    layout.note(std::string(prefix) + path, thumbnails.has(path) ? "thumbnail" : "no thumbnail");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
    thumbnails.draw(path, ImVec2(from.x + pad, from.y + pad), size);
    const std::string name = fs::path(path).stem().string();
    ImGui::PushClipRect(ImGui::GetCursorScreenPos(),
                        ImVec2(from.x + size.x + 2 * pad, from.y + 2 * size.y), true);
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopClipRect();
    ImGui::EndGroup();
    ImGui::PopID();
  }
  return chosen;
}

void OpenDialog::show() {
  std::error_code failed;
  if (folder_.empty()) folder_ = fs::current_path(failed).string();
  enter(folder_);
  shown_ = focus_ = true;
}

void OpenDialog::enter(const std::string& folder) {
  folder_ = folder;
  text_.clear();
  list_ = listFolder(folder_, kind_);
}

// Enters a folder; gives back a file.
std::optional<std::string> OpenDialog::take(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::string path = wholePath(text, folder_);
  std::error_code failed;
  if (!fs::is_directory(path, failed)) return path;
  enter(path);
  return std::nullopt;
}

std::optional<std::string> OpenDialog::drawFiles(Layout& layout) {
  std::optional<std::string> chosen, entered;
  ImGui::BeginChild("files", ImVec2(0, -1.4f * ImGui::GetFrameHeightWithSpacing()), true);
  if (ImGui::Selectable("..")) entered = wholePath("..", folder_);
  layout.note("open up");
  if (!list_.error.empty()) ImGui::TextWrapped("%s: %s", folder_.c_str(), list_.error.c_str());
  if (!list_.error.empty()) layout.note("open error", list_.error);
  for (const ListedFile& file : list_.files) {
    ImGui::PushID(file.name.c_str());
    const std::string label = file.name + (file.folder ? "/" : "");
    if (ImGui::Selectable(label.c_str(), text_ == file.name,
                          ImGuiSelectableFlags_AllowDoubleClick)) {
      if (file.folder) {
        entered = wholePath(file.name, folder_);
      } else {
        // The second click of two that entered a folder chooses nothing.
        const bool again = std::exchange(text_, file.name) == file.name;
        if (again && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) chosen = take(text_);
      }
    }
    layout.note("open file " + file.name);
    ImGui::PopID();
  }
  if (list_.cut) ImGui::TextDisabled("The first %zu; type a path for others", FolderList::kMost);
  ImGui::EndChild();
  if (entered) enter(*entered);
  return chosen;
}

std::optional<std::string> OpenDialog::draw(const ViewerState& state, float left, float right,
                                            float height, Layout& layout) {
  if (!shown_) return std::nullopt;
  const float font = ImGui::GetFontSize();
  const ImVec2 size(std::min(46 * font, right), std::min(34 * font, height));
  ImGui::SetNextWindowPos(ImVec2(std::min((left + right) / 2, right - size.x / 2), height / 2),
                          ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(size);
  if (focus_) ImGui::SetNextWindowFocus();
  std::optional<std::string> chosen;
  ImGui::Begin("Open", &shown_,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize);
  ImGui::TextWrapped("%s", folder_.c_str());
  layout.note("open folder", folder_);
  Completion completion{folder_, kind_};
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
  if (std::exchange(focus_, false)) ImGui::SetKeyboardFocusHere();
  bool open = ImGui::InputTextWithHint(
      "###open path", "a path; Tab completes it", &text_,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion, completeText,
      &completion);
  layout.note("open path", text_);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("###open kind", kindLabel(kind_))) {
    for (size_t i = 0; i < kFileKinds; ++i) {
      const auto kind = static_cast<FileKind>(i);
      if (ImGui::Selectable(kindLabel(kind), kind == kind_)) {
        kind_ = kind;
        list_ = listFolder(folder_, kind_);
      }
      layout.note("open kind." + std::to_string(i));
    }
    ImGui::EndCombo();
  }
  layout.note("open kind", kindLabel(kind_));
  if (!state.recent.empty() && (kind_ == FileKind::kAll || kind_ == FileKind::kScene)) {
    ImGui::BeginChild("recent", ImVec2(0, 6.5f * font));
    chosen = drawRecentScenes(state, thumbnails_, "open recent ", layout);
    ImGui::EndChild();
  }
  if (const auto file = drawFiles(layout)) chosen = file;
  open |= ImGui::Button("Open");
  layout.note("open confirm");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) shown_ = false;
  layout.note("open cancel");
  if (open && !chosen) chosen = take(text_);
  ImGui::End();
  if (chosen) shown_ = false;
  return chosen;
}

}  // namespace grisaille::app::viewer
