// SPDX-License-Identifier: MIT
// The state of the viewer without window and device: scene, camera, chain of effects, views. The
// panel and the keys change it through the functions and public members of Session.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/options/pose_options.h"
#include "app/services/scene_lengths.h"
#include "app/services/scene_services.h"
#include "app/settings/presets.h"
#include "app/settings/settings.h"
#include "app/viewer/camera_history.h"
#include "app/viewer/command_line.h"
#include "app/viewer/history.h"
#include "app/viewer/session_file.h"
#include "app/viewer/stage.h"
#include "app/viewer/tune_run.h"
#include "app/viewer/view_settings.h"
#include "core/base/error.h"
#include "core/effect/selection.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app::viewer {

// Options of the command line.
struct SessionOptions {
  std::string scene, camera, config, surface, background, view, split;
  std::vector<std::string> effects, presets, sets, loads, pluginPaths;
  PoseOptions pose;
  bool effectsGiven = false;
  std::string splitBackend;  // of the right side; "": the window's
  std::optional<SplitWay> splitWay;
  bool compareTruth = false;
  double truthRadius = 0;  // metres; 0: the effect's radius
  uint32_t truthRays = 0;  // per pixel; 0: the default
};

// The pose of the scene, and how it plays.
struct Playback {
  static constexpr double kFrames = 24;  // per second; files name no frame rate

  scene::Pose pose = {};
  bool playing = false;
  double speed = 1;  // seconds of the animation per second
};

// A search that the user requests: `grisaille tune` for one effect in the current view.
struct TuneWish {
  static constexpr uint32_t kMostEvaluations = 100000;

  std::string effect;
  bool byBudget = false;                         // false: `maxError` counts; true: `budget`
  double maxError = 0.1;                         // RMSE, over 0
  double budget = 40;                            // milliseconds, over 0
  uint32_t evaluations = 80;                     // limit, 1 to kMostEvaluations
  std::set<std::string, std::less<>> stay = {};  // keys of parameters to keep
};

// An effect's presets, read from their file when the plugins were loaded.
struct EffectPresets {
  Presets presets;
  std::string error;  // why they cannot be read; else ""
};

// Views that the renderer does not draw: the traced truth, and the error of the compared output
// against it.
constexpr std::string_view kTruthView = "truth", kErrorView = "error";

inline bool isTruthView(std::string_view output) {
  return output == kTruthView || output == kErrorView;
}

// One line of the panel's message list.
struct Message {
  std::string text;
  bool error = false;
  std::string about = {};  // of an error: what attempt() tried; "": it stays
};

// A scene's path in one form: a built-in scene's name, or an absolute path.
std::string sceneKey(const std::string& path);

class Session {
  std::unique_ptr<effect::Registry> registry_;  // first: the members below use its effects

 public:
  static constexpr size_t kMessagesKept = 50;

  // Reads every file that the options name, except the scene. `last`: takes over the last session,
  // except what the options name; of another scene, only effects and views. Throws Error.
  explicit Session(SessionOptions options, const std::optional<SavedSession>& last = {});
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // --- The scene
  // Shows a loaded scene. `path`: its file or name, as of loadScene(). The camera becomes --camera
  // for the first scene if given, else defaultCamera() for a picture of `size` pixels. The first
  // scene takes the pose of the command line; others are at rest.
  void setScene(std::shared_ptr<scene::Scene> loaded, const std::string& path, glm::uvec2 size);
  std::string scenePath;  // a file, or a built-in scene's name; "": the default one
  // The scene to begin with, as the options or the last session name it.
  const std::string& firstScene() const { return options_.scene; }
  std::shared_ptr<const scene::Scene> scene;
  std::unique_ptr<SceneServices> services;  // of the scene
  scene::Camera camera, homeCamera;
  CameraHistory cameraHistory;
  // Sets the camera; cameraHistory keeps where it was.
  void goTo(const scene::Camera& next);
  // The same without cameraHistory. Neither counts as movement: see jumps().
  void jumpTo(const scene::Camera& next);
  uint64_t jumps() const { return jumps_; }  // number of calls so far
  // False if a surface is less than `clearance` metres beyond, or on, the way of the eye from
  // `from` to `to`. Knows no surfaces before findSurfaces(), nor in builds without rays.
  bool isFree(const glm::dvec3& from, const glm::dvec3& to, double clearance);
  // Makes isFree() know the surfaces, a moment later: builds a structure for rays in the
  // background. Does nothing for scenes of more than kMostTriangles, where that would take too much
  // memory.
  static constexpr uint64_t kMostTriangles = 4'000'000;
  void findSurfaces();
  double speed = 1;   // of flying, a factor
  double extent = 0;  // of the scene at rest, metres

  // --- Time; session_time.cpp
  Playback playback;
  bool hasAnimations() const { return scene && !animationsOf(*scene).empty(); }
  bool isPlaying() const { return (playback.playing || preview_) && !paused; }
  double duration() const;     // of the animation, or at rest of the first one; seconds
  double frameNumber() const;  // of the current time, at Playback::kFrames
  double lastFrame() const;    // of the animation
  // Poses the scene. After an error of scene::pose(), the scene is at rest and the error goes on.
  void takePose(const scene::Pose& pose);
  // The functions below do nothing without animations.
  void seek(double seconds);  // a time of the animation; the time line ends at its ends
  // Goes to the start of an animation, or to rest. A camera at home moves to the new home.
  void choose(std::optional<size_t> animation);
  void play(bool on);            // a scene at rest plays its first animation
  void advance(double seconds);  // while it plays: goes on, and from the end to the start
  void stepFrames(int frames);   // pauses; goes to the next or previous whole frame

  // --- Effects
  effect::Chain chain;    // all loaded effects, on or off
  uint64_t revision = 1;  // of the chain's selection; grows with every change
  // Call after every change of the selection. `what` names the step of undo.
  void changed(std::string what) {
    ++revision;
    lastChange_ = std::move(what);
  }
  // Makes all changes since the last call one step of undo. Call when the user drags no control.
  void noteChanges();
  History history;
  void undo();
  void redo();
  const effect::Registry& registry() const { return *registry_; }
  // Back to the default of a parameter: for a length, to the one that follows the scene.
  void resetParameter(effect::Selection::Entry& entry, const std::string& key);
  // Loads plugins that are new or have changed. Calls `before` before it destroys instances of the
  // old plugins.
  void rescan(const std::function<void()>& before);

  // Held settings, for the right side; none: the right side shows the live settings.
  std::optional<effect::Selection> held;
  uint64_t heldRevision = 0;
  void hold();
  void swapHeld();

  // --- Views
  std::string left = "color", right = "normal";  // outputs
  bool split = false;
  float line = 0.5f;  // of the split, as a share of the picture's width
  SplitSettings splitting;
  Fineness fineness;
  frame::Surface surface = frame::Surface::kWhite;
  frame::Background background = frame::kGrey;
  float zoom = 1;                      // pixels per texel
  glm::vec2 centre = glm::vec2(0.5f);  // point in the middle, as a share of the picture
  bool inspecting = false;             // show the value under the cursor
  bool paused = false, step = false, continuous = false;
  // The outputs that a side can show.
  std::vector<Viewable> views(bool rightSide) const;
  // Resets a view to the final picture if its output no longer exists.
  void checkViews();

  // --- Comparison with truth
  TruthSettings comparing;
  // Switches the comparison. On: the left side shows the error, and the right one, unless the
  // picture is split already, the truth. Off: both show their earlier views again. Without a
  // comparable output, adds a message and stays off.
  void compareWithTruth(bool on);
  std::vector<std::string> comparable() const;  // visibility outputs with one channel
  std::string comparedOutput() const;           // "": no comparison, or no comparable output
  double truthRadius() const { return truthRadius(comparedOutput()); }  // metres
  double truthRadius(const std::string& output) const;
  double sceneRadius() const { return suitableRadius_; }  // that suits the scene, metres
  void setTruthRadius(double metres);                     // throws kUsage

  // --- Presets and tuned settings: each is one step of undo
  const EffectPresets& presetsOf(const std::string& effect) const;
  void choosePreset(effect::Selection::Entry& entry, const std::string& name);
  std::string outputToTune(const std::string& effect) const;  // "": none
  // True for a parameter that a search must keep: the radius, if the truth takes its own from it.
  bool staysInTune(std::string_view parameter) const;
  // The search as a command. `view`: size of the picture, pixels. Throws kUsage.
  TuneCommand tuneCommand(const TuneWish& wish, glm::uvec2 view, const std::string& backend,
                          const std::string& device);
  // Sets tuned values of an effect. Throws kUsage if the effect does not exist, and the errors of
  // effect::Values; then changes nothing.
  void takeTuned(const std::string& effect, const std::vector<effect::ParameterValue>& values);

  // --- Objects that users place; session_objects.cpp
  // Keys of the effects that are on and have a table of objects, in order.
  std::vector<std::string> effectsWithObjects() const;
  bool placing = false;  // the left button places an object
  // The effect that receives placed objects: the one chosen last, else the first; "": none.
  std::string placer() const;
  void placeWith(const std::string& effect, bool on);
  // Field values of the next placed object; place() sets point and direction.
  objects::Object& nextObject(const std::string& effect);
  objects::ObjectList& listOf(const std::string& effect);  // throws kEffectTakesNoObjects
  // Calls `change` on the list; a change is one step of undo named `what`. `joins`: merges it into
  // the last step.
  void changeObjects(const std::string& effect, const std::string& what, bool joins,
                     const std::function<void(objects::ObjectList&)>& change);
  // True if a held left button places one object after another: objects placed by a ray.
  bool sprays();
  // Places the next object at a point of a picture of this size, both in texels, from the top left
  // corner. False: no surface to place it on.
  bool place(glm::dvec2 point, glm::uvec2 size, bool joins);
  // The object that the user has selected.
  struct Chosen {
    std::string effect;
    size_t index = 0;
  };
  // None: no object is selected, or it is no longer there.
  std::optional<Chosen> chosen();
  void choose(const std::string& effect, size_t index) { chosen_ = Chosen{effect, index}; }
  void chooseNone() { chosen_.reset(); }
  // The functions below do nothing without a selected object; each change is a step of undo.
  void deleteChosen();
  void reorderChosen(size_t index);  // its new index, at most the last one
  // Moves it to where place() would place it. `joins`: as in changeObjects(). False: no surface.
  bool moveChosen(glm::dvec2 point, glm::uvec2 size, bool joins);
  // Selects the object whose point is nearest to `at` (world), up to `reach` metres away.
  void chooseNear(const glm::dvec3& at, double reach);
  // Where objects are seen, world: their points or, for those placed by a ray, what the rays meet.
  std::vector<glm::dvec3> pointsOf(const objects::ObjectList& list, size_t first, size_t count);
  std::optional<glm::dvec3> chosenPoint();  // of the selected object
  void clearObjects(const std::string& effect);
  void loadObjects(const std::string& effect, const std::string& path);
  void saveObjects(const std::string& effect, const std::string& path);

  // --- Files
  // Opens a file of settings, objects or a camera, told apart by ending and content. Throws Error.
  void openFile(const std::string& path);
  void loadSettings(const std::string& path);
  void saveSettings(const std::string& path);

  // Everything that a session file keeps, except backend and layout; session_save.cpp.
  SavedSession saved();
  // Takes over a session; effects and objects are steps of undo. Camera and pose wait for
  // setScene() unless its scene is here. True if setScene() must follow, with session.scene.
  bool open(const SavedSession& session);

  // Saves settings, objects and camera to a folder. Returns the `grisaille view` command that loads
  // them. Throws kFileUnwritable.
  std::string rescue(const std::filesystem::path& folder);

  // The `grisaille render` command that makes the picture on the screen. Writes the objects to
  // files.
  std::string commandLine(glm::uvec2 size, const std::string& backend, const std::string& device);

  // --- A sequence of pictures along a path of cameras, with the animation or without;
  // session_commands.cpp
  Sequence sequence;
  double sequenceSeconds() const;  // its duration
  uint32_t sequenceFrames() const;
  // Writes the path to a file. Throws kUsage without a path and without an animation.
  RenderCommand sequenceCommand(glm::uvec2 size, const std::string& backend,
                                const std::string& device);
  void previewSequence(bool on);  // moves the camera along the path; nothing without a path
  bool isPreviewing() const { return preview_.has_value(); }

  // --- Messages
  std::deque<Message> messages;  // oldest first
  void say(std::string text, bool error = false) { add({std::move(text), error}); }
  // The end of what attempt() began in the background. failure: "": it succeeded
  void conclude(const std::string& about, const std::string& failure);
  // Calls `action`, and adds a message if it throws Error or a file system error. Rethrows only
  // kDeviceLost. `about` names what is tried, "settings": each call removes the error of the last
  // one about the same. True if the action succeeded.
  bool attempt(const std::string& about, const std::function<void()>& action);

 private:
  RenderCommand command(glm::uvec2 size, const std::string& backend, const std::string& device);
  std::string shownOutput() const;  // of the left side, as a file of it
  void advancePreview(double seconds);
  void add(Message message);
  void forget(const std::string& about);
  void warn(const std::string& file, const std::string& text);
  void apply(const Settings& settings, const std::vector<std::string>& presets);
  // The effect whose objects a file holds; "": none.
  std::string ownerOf(const std::string& path);
  void fitToScene();
  bool reads(uint32_t attachments) const;
  void resume(const SavedSession& last, bool sameScene);
  void applyGiven();
  void takeViews(const SavedSession& session);
  void takeObjects(const SavedSession& session, bool undoable);
  void arrive();
  void beginComparing();
  static constexpr double kWithin = 1e-6;  // rounding of times, frames
  void loadAllPresets();

  SessionOptions options_;
  std::shared_ptr<scene::Scene> posed_;           // the same as `scene`
  std::map<std::string, EffectPresets> presets_;  // by effect
  std::string lastChange_;
  // Camera and pose of a session whose scene is not here yet.
  struct Arrival {
    std::string scene;
    std::optional<scene::Camera> camera;
    scene::Pose pose;
  };
  std::optional<Arrival> arrival_;
  // Objects of a session for effects that are not loaded: kept for the next session file.
  std::map<std::string, std::string> strangeObjects_;  // by effect
  std::string placer_;                                 // effect chosen last
  std::optional<Chosen> chosen_;
  std::map<std::string, objects::Object, std::less<>> next_;   // by effect
  std::string leftBefore_ = "color", rightBefore_ = "normal";  // views before the comparison
  uint64_t jumps_ = 0;
  std::optional<double> preview_;  // seconds of the sequence; none: no preview
  bool firstScene_ = true;
  bool homeGiven_ = false;                // by --camera
  double aspect_ = 1;                     // of the picture when the scene was loaded
  double suitableRadius_ = kUsualRadius;  // of the scene, metres
};

}  // namespace grisaille::app::viewer
