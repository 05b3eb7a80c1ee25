// SPDX-License-Identifier: MIT
// The viewer's session files: the last session, and those that the user opens and saves.
#include <filesystem>

#include "app/viewer/viewer.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

fs::path lastFile() {
  return stateFolder() / "session.json";
}

}  // namespace

// The session to begin with. A damaged last session is kept under another name.
std::optional<SavedSession> Viewer::firstSession() {
  setsAside_ = !options_.sessionFile.empty();
  if (!options_.sessionFile.empty()) return loadSession(options_.sessionFile);
  std::error_code failed;
  const fs::path file = lastFile();
  if (!keepsSession() || !fs::exists(file, failed)) return std::nullopt;
  setsAside_ = options_.fresh;
  if (options_.fresh) return std::nullopt;
  try {
    SavedSession last = loadSession(file);
    const std::string& scene = options_.session.scene;
    setsAside_ = !scene.empty() && sceneKey(scene) != sceneKey(last.scene);
    return last;
  } catch (const Error& error) {
    const fs::path kept = file.string() + ".damaged";
    fs::rename(file, kept, failed);
    const std::string where = failed ? "it cannot be renamed" : "it is kept as " + kept.string();
    stateMessage_ += (stateMessage_.empty() ? "" : "; ") +
                     std::string(Error(error.id(), "{}; {}", error.detail(), where).what());
    return std::nullopt;
  }
}

SavedSession Viewer::saved() {
  SavedSession session = session_.saved();
  session.backend = backend_;
  session.layout = state_.layout;
  return session;
}

void Viewer::keepSession() {
  if (!keepsSession()) return;
  std::error_code failed;
  const fs::path file = lastFile();
  // A fresh start, or another scene, must not lose the session before it.
  if (std::exchange(setsAside_, false)) {
    fs::rename(file, stateFolder() / "session-before.json", failed);
  }
  saveSession(saved(), file);
}

void Viewer::saveSessionTo(const std::string& path) {
  if (fs::path(path).extension() != ".json") {
    throw Error(ErrorId::kUsage, "the session's file '{}' does not end in .json", path);
  }
  saveSession(saved(), path);
  session_.say("session to " + path);
}

void Viewer::openSession(const std::string& path) {
  const SavedSession session = loadSession(path);
  if (session.layout) state_.layout = *session.layout;
  if (session_.open(session)) openScene(session.scene);
  session_.say("session from " + path);
  settle_ = kSettleFrames;
}

}  // namespace grisaille::app::viewer
