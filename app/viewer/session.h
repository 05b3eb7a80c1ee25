// SPDX-License-Identifier: MIT
// What is looked at and how: scene, camera, the chain of effects, views. No window,
// no device; every change of it goes through here or through the members that the panel edits.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/services/scene_services.h"
#include "app/settings/presets.h"
#include "app/settings/settings.h"
#include "app/viewer/history.h"
#include "app/viewer/stage.h"
#include "app/viewer/tune_run.h"
#include "core/base/error.h"
#include "core/effect/selection.h"
#include "core/scene/camera.h"

namespace grisaille::app::viewer {

// As the command line has them.
struct SessionOptions {
  std::string scene, camera, config, surface, view, split;
  std::vector<std::string> effects, presets, sets, loads, pluginPaths;
  bool effectsGiven = false;
  bool compareTruth = false;
  double truthRadius = 0;  // metres; 0: the effect's own
  uint32_t truthRays = 0;  // 0: as many as usual
};

// What the picture is compared with while it is looked at.
struct TruthSettings {
  static constexpr uint32_t kLeastRays = 16, kMostRays = 4096;
  static constexpr double kFarthest = 1e6;  // metres

  bool on = false;
  std::string output = "";            // that is compared; "": the first there is
  std::optional<double> radius = {};  // metres, over 0 to kFarthest; none: the effect's own
  uint32_t rays = 256;                // a pixel, kLeastRays ... kMostRays
};

// What `grisaille tune` is to find for an effect, in the view as it is.
struct TuneWish {
  static constexpr uint32_t kMostEvaluations = 100000;

  std::string effect;
  bool byBudget = false;
  double maxError = 0.1;                         // RMSE, over 0
  double budget = 40;                            // milliseconds, over 0
  uint32_t evaluations = 80;                     // at most, 1 to kMostEvaluations
  std::set<std::string, std::less<>> stay = {};  // keys of parameters that may not change
};

// An effect's presets, as their file had them when the plugins were scanned.
struct EffectPresets {
  Presets presets;
  std::string error;  // why they cannot be read; "": they can
};

// Views that no frame has: of the truth that is traced, and how far the picture is from it.
constexpr std::string_view kTruthView = "truth", kErrorView = "error";

inline bool isTruthView(std::string_view output) {
  return output == kTruthView || output == kErrorView;
}

// One line for the user to read.
struct Message {
  std::string text;
  bool error = false;
};

class Session {
  std::unique_ptr<effect::Registry> registry_;  // before the effects that it holds

 public:
  static constexpr size_t kMessagesKept = 50;

  // Reads what the options name but for the scene. Throws Error.
  explicit Session(SessionOptions options);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // --- The scene
  // With its own camera: the file of the command line for the first scene, else an overview.
  void setScene(std::shared_ptr<const scene::Scene> loaded, const std::string& path);
  std::string scenePath;  // "": the built-in scene
  std::shared_ptr<const scene::Scene> scene;
  std::unique_ptr<SceneServices> services;  // of the scene
  scene::Camera camera, homeCamera;
  double speed = 1;  // metres a second, of flying

  // --- Effects
  effect::Chain chain;    // of all effects there are
  uint64_t revision = 1;  // of its selection; to be raised with every change
  void changed(std::string what) {
    ++revision;
    lastChange_ = std::move(what);
  }
  // Makes what has changed since the last call one step of undo. When no control is being dragged.
  void noteChanges();
  History history;
  void undo();
  void redo();
  const effect::Registry& registry() const { return *registry_; }
  // Loads plugins that are new or have changed. `before` is called before instances of the old ones
  // end.
  void rescan(const std::function<void()>& before);

  // The settings that the picture is compared with.
  std::optional<effect::Selection> held;
  uint64_t heldRevision = 0;
  void hold();
  void swapHeld();

  // --- Views
  std::string left = "color", right = "normal";  // outputs
  bool split = false;
  float line = 0.5f;  // of the picture's width
  frame::Surface surface = frame::Surface::kWhite;
  float zoom = 1;                      // pixels a texel
  glm::vec2 centre = glm::vec2(0.5f);  // of what is seen, in parts of the picture
  bool inspecting = false;             // the value under the cursor
  bool paused = false, step = false, continuous = false;
  // What a side can show.
  std::vector<Viewable> views(bool rightSide) const;
  // Outputs that are gone become the final picture.
  void checkViews();

  // --- Comparing with truth
  TruthSettings comparing;
  // The left side shows the error, or again what it showed before.
  void compareWithTruth(bool on);
  std::vector<std::string> comparable() const;  // outputs of one channel: each effect's visibility
  std::string comparedOutput() const;           // "": there is none, or nothing is compared
  double truthRadius() const { return truthRadius(comparedOutput()); }  // metres
  double truthRadius(const std::string& output) const;
  void setTruthRadius(double metres);  // throws kUsage

  // --- Presets, and settings that are searched for: each a step of undo
  const EffectPresets& presetsOf(const std::string& effect) const;
  void choosePreset(effect::Selection::Entry& entry, const std::string& name);
  std::string outputToTune(const std::string& effect) const;  // "": there is none
  // The radius says what is asked for where the truth has it too.
  bool staysInTune(std::string_view parameter) const;
  // `view`: pixels. Throws kUsage.
  TuneCommand tuneCommand(const TuneWish& wish, glm::uvec2 view, const std::string& backend,
                          const std::string& device);
  // Values of that effect. Throws as effect::Values does and where the effect is gone, and then
  // changes nothing.
  void takeTuned(const std::string& effect, const std::vector<effect::ParameterValue>& values);

  // --- Objects that users make; session_objects.cpp
  // Effects that are on and whose tables declare some, in order.
  std::vector<std::string> effectsWithObjects() const;
  bool placing = false;  // the left button places an object
  // The effect that it is placed for: the one chosen last, or the first; "": there is none.
  std::string placer() const;
  void placeWith(const std::string& effect, bool on);
  // What the next object is like, but for its place.
  objects::Object& nextObject(const std::string& effect);
  objects::ObjectList& listOf(const std::string& effect);  // throws kEffectTakesNoObjects
  // One step of undo, where `change` changes anything; `joins` the step before.
  void changeObjects(const std::string& effect, const std::string& what, bool joins,
                     const std::function<void(objects::ObjectList&)>& change);
  // While the left button is held, objects follow each other: those that rays place.
  bool sprays();
  // At a point of a picture of this size, from its top left corner. False: nothing is seen there
  // that it could be placed on.
  bool place(glm::dvec2 point, glm::uvec2 size, bool joins);
  void clearObjects(const std::string& effect);
  void loadObjects(const std::string& effect, const std::string& path);
  void saveObjects(const std::string& effect, const std::string& path);

  // --- Files
  // A file of settings, objects or a camera, by its ending and content. Throws Error.
  void openFile(const std::string& path);
  void loadSettings(const std::string& path);
  void saveSettings(const std::string& path);

  // Writes what no file holds yet into a folder: settings, objects, camera. The command that goes
  // on from there. Throws kFileUnwritable.
  std::string rescue(const std::filesystem::path& folder);

  // The command that makes the picture on the screen; objects are written to a file.
  std::string commandLine(glm::uvec2 size, const std::string& backend, const std::string& device);

  // --- What there is to say
  std::deque<Message> messages;  // oldest first
  void say(std::string text, bool error = false);
  // Does it, and says why it failed where it did. Throws kDeviceLost alone.
  void attempt(const std::function<void()>& action);

 private:
  void apply(const Settings& settings, const std::vector<std::string>& presets);
  std::string ownerOf(const std::string& path);  // the effect whose objects a file holds; "": none
  void beginComparing();
  void loadAllPresets();

  SessionOptions options_;
  std::map<std::string, EffectPresets> presets_;  // by effect
  std::string lastChange_;
  std::string placer_;                                        // chosen last
  std::map<std::string, objects::Object, std::less<>> next_;  // by effect
  std::string leftBefore_ = "color";                          // comparing
  bool firstScene_ = true;
};

}  // namespace grisaille::app::viewer
