// SPDX-License-Identifier: MIT
// The viewer's state that persists between runs, and the folders for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/viewer/session_file.h"

namespace grisaille::app::viewer {

// stateFolder(): $XDG_STATE_HOME/grisaille or ~/.local/state/grisaille. configFolder():
// $XDG_CONFIG_HOME/grisaille or ~/.config/grisaille. Neither function creates the folder.
std::filesystem::path stateFolder();
std::filesystem::path configFolder();

// The current local time, for file names: "20261121-143000".
std::string timeStamp();

struct ViewerState {
  std::vector<std::string> recent;      // scenes, absolute paths, newest first, at most 12
  uint32_t width = 1600, height = 900;  // of the window, in screen units, 1 ... 16384
  PanelLayout layout;

  // Makes `path` the newest scene. Ignores built-in scenes, "" among them.
  void noteRecent(const std::string& path);

  bool operator==(const ViewerState&) const = default;
};

// Never throws. Returns the defaults if the file is missing or damaged. Renames a damaged file to
// `<file>.damaged` and sets `message` to the reason, one line; else sets `message` to "".
ViewerState loadState(const std::filesystem::path& file, std::string& message);

// Writes the state atomically; creates the folder. Leaves out recent paths that are not UTF-8.
// Throws kFileUnwritable.
void saveState(const ViewerState& state, const std::filesystem::path& file);

// A settings file that the user saved under a name.
struct SavedSettings {
  std::string name;  // of the file, without .toml
  std::filesystem::path path;
};

// The files folder/settings/*.toml, sorted by name.
std::vector<SavedSettings> savedSettings(const std::filesystem::path& folder = configFolder());

}  // namespace grisaille::app::viewer
