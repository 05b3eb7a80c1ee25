// SPDX-License-Identifier: MIT
// The panel: every effect's parameters from its own table, views, objects, cost, files. It edits
// the session and asks the viewer for what a session cannot do.
#pragma once

#include <imgui/imgui.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/report/coverage.h"
#include "app/truth/comparison.h"
#include "app/viewer/bookmarks.h"
#include "app/viewer/layout.h"
#include "app/viewer/pass_stats.h"
#include "app/viewer/session.h"
#include "app/viewer/state_file.h"

namespace grisaille::app::viewer {

inline const ImVec4 kErrorColour(0.90f, 0.62f, 0.00f, 1);  // of words about what went wrong

// Of the comparing with truth.
struct TruthStatus {
  bool running = false;
  truth::Comparison comparison;
  double rays = 0;                          // a traced pixel, on average
  double share = 0;                         // of the picture's pixels
  std::optional<truth::Point> cursor = {};  // of the texel under it
};

// Of the search for a setting.
struct TuneStatus {
  std::string effect;  // that it is for, or was; "": there was none yet
  bool running = false;
  TuneRun::State state;
  TuneRun::Outcome outcome;  // of the last one
};

// What the panel shows besides the session.
struct Status {
  gpu::DeviceInfo device;
  std::vector<PassStats> passes;
  PassStats whole;
  std::vector<ColorShare> coverage;
  std::vector<float> cursorValue;  // of the texel under the cursor; empty: none
  glm::ivec2 cursorTexel = glm::ivec2(0);
  glm::uvec2 picture = glm::uvec2(0);  // pixels
  uint64_t waiting = 0;                // objects that are not drawn yet
  TruthStatus truth;
  TuneStatus tune;
  std::optional<double> loading;  // share of a scene that is read
  std::string loadingPath;
  std::string rebuilding;    // the effect whose plugin is being built; "": none
  std::string buildMessage;  // why the last build failed; "": it did not
};

// What the panel asks for.
struct Requests {
  std::optional<std::string> scene;  // to open; "": the built-in one
  std::optional<TuneWish> tune;
  bool cancelTune = false;
  bool rescan = false, picture = false, copyCommand = false, help = false, quit = false;
};

class Panel {
 public:
  Panel(Session& session, ViewerState& state, Bookmarks& bookmarks)
      : session_(session), state_(state), bookmarks_(bookmarks) {}

  // Between ImGui::NewFrame() and ImGui::Render(); the units of the window.
  Requests draw(const Status& status, glm::vec2 window);

  // Units of the window that it takes from the left; 0 when it is hidden.
  float width(glm::vec2 window) const;

  void refreshLists() { listsFresh_ = false; }
  void saveSettings() {
    session_.attempt([&] { session_.saveSettings(settingsPath_); });
  }

  bool shown = true, help = false, wantsCoverage = false;
  glm::uvec2 pictureSize = glm::uvec2(1920, 1080);  // of pictures that are saved
  bool pictureAsShown = true;                       // with the size on the screen
  Layout layout;

 private:
  // panel.cpp
  void drawMessages();
  void drawScene(const Status& status, Requests& requests);
  void drawCamera();
  void drawSettings(Requests& requests);
  void drawHelp(glm::vec2 window);
  // panel_effects.cpp
  void drawEffects(const Status& status, Requests& requests);
  void drawEffect(effect::Selection::Entry& entry, size_t index, const Status& status,
                  Requests& requests);
  void drawParameters(effect::Selection::Entry& entry);
  void drawParameter(effect::Selection::Entry& entry, const grisaille_param_desc& param);
  bool editParameter(const effect::Selection::Entry& entry, const grisaille_param_desc& param,
                     double& value);
  void drawCost(const Status& status);
  // panel_tune.cpp
  void drawPresets(effect::Selection::Entry& entry);
  void drawTune(const effect::Selection::Entry& entry, const TuneStatus& status,
                Requests& requests);
  TuneWish& wishOf(const std::string& effect);
  void drawWish(const effect::Selection::Entry& entry, TuneWish& wish);
  void drawMayChange(const effect::Selection::Entry& entry, TuneWish& wish);
  void drawOutcome(const TuneStatus& status);
  // panel_views.cpp
  void drawViews(const Status& status, Requests& requests);
  void drawViewChoice(const char* label, const char* id, std::string& output,
                      const std::vector<Viewable>& all);
  // panel_objects.cpp
  void drawObjects(const Status& status);
  void drawObjectsOf(const std::string& effect, const Status& status);
  void drawObjectFile(const std::string& effect);
  void drawObjectList(const std::string& effect);
  void drawSelected(const std::string& effect, size_t index);
  struct Draft {  // a text that is being typed
    std::string effect;
    size_t index, field;  // of the object, of its field
    std::string text;
  };
  void draftText(const objects::Field& field, const std::string& id, Draft draft);
  void takeDraft();
  bool editField(const objects::Field& field, const std::string& id, objects::Value& value);
  void drawCoverage(const Status& status);
  // panel_truth.cpp
  void drawTruth(const TruthStatus& status);
  void drawTruthSettings();

  bool button(const char* label, const char* id, const char* tooltip = "");
  bool toggle(const char* label, const char* id, bool& value, const char* tooltip = "");
  bool path(const char* label, const char* id, std::string& text);

  Session& session_;
  ViewerState& state_;
  Bookmarks& bookmarks_;
  std::string scenePath_, settingsPath_ = "settings.toml", savedName_;
  std::string bookmarkName_;
  std::vector<Bookmarks::Entry> bookmarkList_;
  std::vector<SavedSettings> savedList_;
  bool listsFresh_ = false;
  size_t messagesSeen_ = 0;
  std::map<std::string, TuneWish> wishes_;          // by effect
  std::map<std::string, std::string> objectPaths_;  // by effect
  std::map<std::string, size_t> selected_;          // by effect, index of an object
  std::map<std::string, size_t> sizes_;             // by effect, objects in the last frame
  std::optional<Draft> draft_;
  bool drafting_ = false;                                // its control still has the focus
  std::string editing_;                                  // the field that is being edited; "": none
  std::optional<std::pair<std::string, double>> typed_;  // parameter and value, not yet taken
};

}  // namespace grisaille::app::viewer
