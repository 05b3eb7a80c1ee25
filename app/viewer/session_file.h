// SPDX-License-Identifier: MIT
// Session files: everything that a user of the viewer has set, as one file of JSON. The viewer
// writes one when it closes, and users save, share and open others.
//
//   {"grisaille_session": 1,
//    "scene": "/models/hall.glb",        absolute, or the name of a built-in scene
//    "scene_beside": "models/hall.glb",  the same, from the folder of the session file
//    "camera": {...}, "effects": [{"key": "blur", "on": true, "values": {"size": "0.5"}}, ...],
//    "objects": {"stickers": {"version": 1, "decals": [...]}}, ...}
//
// A file never names plugins: opening one must not run foreign code.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "app/viewer/view_settings.h"
#include "core/effect/selection.h"
#include "core/scene/camera.h"
#include "core/scene/rig.h"

namespace grisaille::app::viewer {

// The panel's own state.
struct PanelLayout {
  static constexpr double kNarrowest = 5, kWidest = 200;          // panelWidth
  static constexpr double kSmallestText = 0.5, kLargestText = 4;  // textScale
  static constexpr size_t kMostSections = 64;

  double textScale = 1;
  bool light = false;      // the light theme, else the dark one
  double panelWidth = 26;  // in heights of the text
  // Open or not; only sections that the user has opened or closed, at most kMostSections.
  std::map<std::string, bool, std::less<>> sections = {};

  bool operator==(const PanelLayout&) const = default;
};

struct SavedSession {
  std::string scene;  // an absolute path, or a built-in scene; "": the default one
  scene::Pose pose;
  std::optional<scene::Camera> camera;  // none: the scene's
  effect::Selection::State effects;
  std::optional<effect::Selection::State> held;
  std::map<std::string, std::string> objects;      // by effect: the text of an object file
  std::string surface = "white", background = "";  // as in settings files; "": the default
  std::string left = "color", right = "normal";    // outputs
  bool split = false, inspecting = false;
  float line = 0.5f;
  SplitSettings splitting;
  Fineness fineness;
  TruthSettings comparing;
  Sequence sequence;
  std::string backend;                // of the window; "": any
  std::optional<PanelLayout> layout;  // none: stays as it is
};

// The text of a file in `folder`, which makes "scene_beside" relative.
std::string sessionJson(const SavedSession& session, const std::filesystem::path& folder);

// Reads the text of a file in `folder`; a scene that is not at its path is looked for beside the
// file. Ignores members that it does not know. Throws kSessionFile, which names the member.
SavedSession parseSession(std::string_view text, const std::filesystem::path& folder);

// Both throw kSessionFile or kFileUnwritable, with the path. saveSession() writes atomically, and
// creates the folder.
SavedSession loadSession(const std::filesystem::path& file);
void saveSession(const SavedSession& session, const std::filesystem::path& file);

// Whether a file begins as sessions do. False for a file that cannot be read.
bool isSessionFile(const std::filesystem::path& file);

}  // namespace grisaille::app::viewer
