// SPDX-License-Identifier: MIT
// The panel: the parameters of every effect, built from the effect's table; views, objects, cost,
// files. It edits the session, and returns requests for the viewer to perform.
#pragma once

#include <imgui/imgui.h>

#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/report/coverage.h"
#include "app/truth/comparison.h"
#include "app/viewer/bookmarks.h"
#include "app/viewer/interface.h"
#include "app/viewer/layout.h"
#include "app/viewer/open_dialog.h"
#include "app/viewer/pass_stats.h"
#include "app/viewer/session.h"
#include "app/viewer/side_difference.h"
#include "app/viewer/state_file.h"

namespace grisaille::app::viewer {

// State of the comparison with the truth.
struct TruthStatus {
  bool running = false;
  truth::Comparison comparison;
  double rays = 0;                          // mean per traced pixel
  double share = 0;                         // traced share of the pixels, 0 ... 1
  std::optional<truth::Point> cursor = {};  // of the texel under the cursor
};

// State of the search that `grisaille tune` runs.
struct TuneStatus {
  std::string effect;  // of this search, or of the last one; "": no search yet
  bool running = false;
  TuneRun::State state;
  TuneRun::Outcome outcome;  // of the last search
};

// State of the sequence that `grisaille render` makes.
struct SequenceStatus {
  bool running = false;
  double done = 0;  // 0 ... 1
  std::string text;
};

// State that the panel shows besides the session.
struct Status {
  gpu::DeviceInfo device;
  std::vector<PassStats> passes;
  PassStats sum, whole;
  std::vector<ColorShare> coverage;
  // Of the texel under the cursor, on the left and the right side; empty: none.
  std::array<std::vector<float>, 2> cursorValues;
  bool cursorRight = false;  // the cursor is on the right side
  glm::ivec2 cursorTexel = glm::ivec2(0);
  glm::uvec2 picture = glm::uvec2(0);  // pixels
  bool halved = false;                 // drawn at half the resolution
  uint32_t averaged = 0;               // frames in the picture
  uint32_t toAverage = 1;              // once it rests
  uint64_t waiting = 0;                // objects still to be drawn
  uint64_t givenUp = 0;                // the oldest, for which a limit leaves no room
  uint64_t coarser = 0;                // old ones, drawn less exactly because of a limit
  std::array<std::string, 2> sides;    // what each side of a split picture shows
  std::optional<SideNumbers> apart;    // none: the sides show different kinds of values
  bool turned = false;                 // the right side is shown in turn
  std::string backend;                 // of the window
  std::vector<frame::LeftOut> leftOut;
  TruthStatus truth;
  TuneStatus tune;
  SequenceStatus sequence;
  std::optional<double> loading;  // share of the scene that is read, 0 ... 1
  std::string loadingPath;
  // Why the last scene could not be opened, and no scene has been since; "": none.
  std::string failedScene;
  std::string rebuilding;    // build target of the plugin being built; "": none
  std::string buildMessage;  // why the last build failed; "": it succeeded
};

// Actions that the panel and the keys request from the viewer.
struct Requests {
  std::optional<std::string> scene;  // to open; "": the built-in scene
  std::optional<std::string> file;   // to open: a scene or any other kind
  bool openDialog = false, cancelLoading = false, closeFailure = false;
  std::optional<std::string> backend;                   // that shall open the window
  std::optional<std::string> openSession, saveSession;  // files
  std::optional<TuneWish> tune;
  bool cancelTune = false, sequence = false, cancelSequence = false;
  bool rescan = false, picture = false, copyCommand = false, help = false, quit = false;
};

class Panel {
 public:
  Panel(Session& session, ViewerState& state, Bookmarks& bookmarks)
      : session_(session), state_(state), bookmarks_(bookmarks) {}

  // The panel's own file dialog, and the thumbnails that it shows.
  void showOpenDialog() {
    thumbnails.read(state_.recent);
    dialog_.show();
  }
  void closeDialogs() {
    help = false;
    dialog_.close();
  }

  // Call between ImGui::NewFrame() and ImGui::Render(). `window`: size, in the window's units.
  Requests draw(const Status& status, glm::vec2 window);

  // Width at the left of the window, in the window's units; 0 if hidden.
  float width(glm::vec2 window) const;

  // Gives the panel's controls the keyboard, if the panel is shown.
  void takeFocus() { wantsFocus_ = shown; }

  void refreshLists() { listsFresh_ = false; }
  void saveSettings() {
    session_.attempt("settings to save", [&] { session_.saveSettings(settingsPath_); });
  }

  bool shown = true, help = false, wantsCoverage = false;
  bool scrolls = false;  // after draw(): the newest message comes into sight in the next frame
  glm::uvec2 pictureSize = glm::uvec2(1920, 1080);  // of saved pictures
  bool pictureAsShown = true;                       // save at the size on the screen
  Layout layout;
  Thumbnails thumbnails{stateFolder() / "thumbnails"};

 private:
  // panel.cpp
  void drawBackend(const Status& status, Requests& requests);
  void drawBorder(glm::vec2 window);
  bool section(const char* label, bool open);
  void drawScene(Requests& requests);
  void drawCamera();
  void drawSettings(Requests& requests);
  void drawHelp(glm::vec2 window);
  // panel_effects.cpp
  void drawEffects(const Status& status, Requests& requests);
  void drawEffect(effect::Selection::Entry& entry, size_t index, const Status& status,
                  Requests& requests);
  void drawParameters(effect::Selection::Entry& entry);
  void drawUnused(effect::Selection::Entry& entry);
  void drawParameter(effect::Selection::Entry& entry, const grisaille_param_desc& param);
  void drawSceneLength(effect::Selection::Entry& entry, const grisaille_param_desc& param);
  bool editParameter(const effect::Selection::Entry& entry, const grisaille_param_desc& param,
                     double& value);
  // panel_cost.cpp
  void drawCost(const Status& status);
  void drawCostGraph(const std::vector<PassStats>& rows, size_t passes, float top);
  void saveCost(const Status& status);
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
  void drawBackground();
  void drawFineness(const Status& status);
  void drawViewChoice(const char* label, const char* id, std::string& output,
                      const std::vector<Viewable>& all);
  // panel_split.cpp
  void drawSplit(const Status& status);
  void drawRightBackend(const Status& status);
  void drawSplitWay();
  // panel_readout.cpp
  // The height that readout and messages take from the controls above them.
  float heightBelow(const Status& status, glm::vec2 window);
  void drawReadout(const Status& status);
  void drawMessages();
  // panel_sequence.cpp
  void drawSequence(const Status& status, Requests& requests);
  void drawPath();
  // panel_time.cpp
  void drawTime();
  void drawAnimationChoice();
  // panel_objects.cpp
  void drawObjects(const Status& status);
  void drawObjectsOf(const std::string& effect, const Status& status);
  void drawObjectFile(const std::string& effect);
  void drawObjectList(const std::string& effect);
  void drawSelected(const std::string& effect, size_t index);
  struct Draft {  // text of an object that the user is typing
    std::string effect;
    size_t index, field;  // of the object, and of the field in its table
    std::string text;
  };
  void draftText(const objects::Field& field, const std::string& id, Draft draft);
  void takeDraft();
  bool editField(const objects::Field& field, const std::string& id, objects::Value& value);
  void drawCoverage(const Status& status);
  // panel_truth.cpp
  void drawTruth();
  void drawTruthSettings();

  // panel_items.cpp
  static constexpr float kItem = 0.58f;  // width of a control beside its name, of the panel's width
  bool button(const char* label, const char* id, const char* tooltip = "");
  bool toggle(const char* label, const char* id, bool& value, const char* tooltip = "");
  // A text field for a path or a name, which leaves room for the buttons with these labels in its
  // line. True if the user pressed Enter.
  bool path(const char* label, const char* id, std::string& text,
            std::initializer_list<const char*> buttons);
  // Shows a tooltip while the last item is hovered; wraps it to fit into the window.
  void tip(const std::string& text);
  // The label of a control with this id, and its width: `share` of the panel's, less for a long
  // name. A name for which even that is too little is drawn above the control.
  std::string fit(const std::string& name, const std::string& id, float share = kItem);
  // The end of a path that is too long for the panel, after an ellipsis.
  static std::string fitted(const std::string& path);

  // panel_scene.cpp
  void drawLoading(const Status& status, glm::vec2 window, Requests& requests);
  void drawFailure(const Status& status, glm::vec2 window, Requests& requests);

  Session& session_;
  ViewerState& state_;
  Bookmarks& bookmarks_;
  OpenDialog dialog_{thumbnails};
  std::string scenePath_, settingsPath_ = "settings.toml", savedName_;
  std::string sessionPath_ = "session.json";
  std::string bookmarkName_;
  std::vector<Bookmarks::Entry> bookmarkList_;
  std::vector<SavedSettings> savedList_;
  bool listsFresh_ = false, wantsFocus_ = false;
  size_t messagesSeen_ = 0;
  std::string messageSeen_;                                    // the newest one
  float readoutHeight_ = 0;                                    // in the window's units
  std::map<std::string, TuneWish> wishes_;                     // by effect
  std::map<std::string, std::string> objectPaths_;             // by effect
  std::map<std::string, std::optional<size_t>> chosenBefore_;  // by effect: selected last frame
  std::optional<Draft> draft_;
  bool drafting_ = false;                                // the draft's control still has the focus
  std::string editing_;                                  // the field being edited; "": none
  std::optional<std::pair<std::string, double>> typed_;  // parameter and value, not applied yet
};

}  // namespace grisaille::app::viewer
