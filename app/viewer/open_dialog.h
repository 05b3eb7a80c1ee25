// SPDX-License-Identifier: MIT
// The panel's own file dialog, for desktops without a portal: folders, a filter by kind, a typed
// path that Tab completes, and the scenes opened last with their thumbnails.
#pragma once

#include <optional>
#include <string>

#include "app/viewer/file_list.h"
#include "app/viewer/layout.h"
#include "app/viewer/state_file.h"
#include "app/viewer/thumbnails.h"

namespace grisaille::app::viewer {

class OpenDialog {
 public:
  explicit OpenDialog(Thumbnails& thumbnails) : thumbnails_(thumbnails) {}

  void show();
  void close() { shown_ = false; }
  bool isShown() const { return shown_; }

  // Draws the dialog if it is shown. Returns the path that the user has chosen. Call between
  // ImGui::NewFrame() and ImGui::Render().
  // left, right, height: the window's part beside the panel, in the window's units
  std::optional<std::string> draw(const ViewerState& state, float left, float right, float height,
                                  Layout& layout);

 private:
  std::optional<std::string> drawRecent(const ViewerState& state, Layout& layout);
  std::optional<std::string> drawFiles(Layout& layout);
  std::optional<std::string> take(const std::string& text);
  void enter(const std::string& folder);

  Thumbnails& thumbnails_;
  bool shown_ = false, focus_ = false;
  FileKind kind_ = FileKind::kAll;
  std::string folder_, text_;
  FolderList list_;  // of folder_
};

// One button for each scene opened last, with its thumbnail and name. Returns the chosen path.
std::optional<std::string> drawRecentScenes(const ViewerState& state, Thumbnails& thumbnails,
                                            const char* prefix, Layout& layout);

}  // namespace grisaille::app::viewer
