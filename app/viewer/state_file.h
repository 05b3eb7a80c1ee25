// SPDX-License-Identifier: MIT
// What the viewer keeps from one run to the next, and where.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace grisaille::app::viewer {

// $XDG_STATE_HOME/grisaille or ~/.local/state/grisaille, $XDG_CONFIG_HOME/grisaille or
// ~/.config/grisaille. They may not be there yet.
std::filesystem::path stateFolder();
std::filesystem::path configFolder();

// Of now, for the names of files: "20261121-143000", local.
std::string timeStamp();

struct ViewerState {
  std::vector<std::string> recent;      // scenes, absolute paths, newest first, at most 12
  uint32_t width = 1600, height = 900;  // of the window, screen units, 1 ... 16384
  double textScale = 1;                 // 0.5 ... 4

  // Makes it the newest. An empty path, the built-in scene, is none.
  void noteRecent(const std::string& path);

  bool operator==(const ViewerState&) const = default;
};

// Never fails. Without a file: the defaults. A damaged file is renamed to `<file>.damaged` and says
// why in `message`, one line; else `message` is "".
ViewerState loadState(const std::filesystem::path& file, std::string& message);

// Writes the file aside and renames it; makes its folder. Throws kFileUnwritable. Recent paths that
// are no UTF-8 are left out.
void saveState(const ViewerState& state, const std::filesystem::path& file);

// A settings file of the user's own, not one of an effect's presets.
struct SavedSettings {
  std::string name;  // of the file, without its ending
  std::filesystem::path path;
};

// The files folder/settings/*.toml, by name.
std::vector<SavedSettings> savedSettings(const std::filesystem::path& folder = configFolder());

}  // namespace grisaille::app::viewer
