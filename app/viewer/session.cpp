// SPDX-License-Identifier: MIT
#include "app/viewer/session.h"

#include <algorithm>
#include <filesystem>

#include "app/options/camera_option.h"
#include "app/options/object_options.h"
#include "app/settings/background.h"
#include "app/settings/chosen_effects.h"
#include "app/settings/load_effects.h"
#include "app/viewer/command_line.h"
#include "app/viewer/state_file.h"
#include "core/base/atomic_file.h"
#include "core/base/quote.h"
#include "core/objects/object_file.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

frame::Surface surfaceOf(const std::string& name) {
  return name == "base" ? frame::Surface::kBaseColour : frame::Surface::kWhite;
}

const char* nameOf(frame::Surface surface) {
  return surface == frame::Surface::kBaseColour ? "base" : "white";
}

// A file's settings, overridden by those of the command line.
Settings asked(const SessionOptions& options, Settings settings) {
  if (options.effectsGiven) settings.effects = options.effects;
  for (const std::string& text : options.sets) {
    const effect::Assignment set = effect::parseAssignment(text);
    settings.values.push_back({.name = set.name, .text = set.value, .place = "--set"});
  }
  return settings;
}

}  // namespace

Session::Session(SessionOptions options, const std::optional<SavedSession>& last)
    : registry_(loadEffects(options.pluginPaths)),
      chain(effect::Selection(*registry_)),
      history(
          chain.state(),
          [this](const effect::Selection::State& state) {
            for (const std::string& dropped : chain.restore(state)) say(dropped);
            ++revision;
          },
          [this](std::string_view effect) { return chain.objectsEvenIfAbsent(effect); }),
      options_(std::move(options)) {
  const Settings settings = options_.config.empty() ? Settings{} : readSettings(options_.config);
  SavedSession kept = last.value_or(SavedSession{});
  const bool sameScene = options_.scene.empty() || sceneKey(options_.scene) == sceneKey(kept.scene);
  if (last) resume(kept, sameScene);
  if (!sameScene) kept.sequence.keys.clear();  // the path belongs to its scene
  if (!last || !options_.config.empty()) {
    apply(asked(options_, settings), options_.presets);
  } else {
    applyGiven();
  }
  history.begin(chain.state());  // what the command line asks for is no step of undo
  loadAllPresets();
  surface = surfaceOf(!options_.surface.empty() ? options_.surface
                                                : settings.surface.value_or(kept.surface));
  background =
      backgroundOf(!options_.background.empty() ? options_.background
                                                : settings.background.value_or(kept.background))
          .value_or(background);
  takeViews(kept);
  if (!options_.camera.empty()) camera = cameraOf(options_.camera, "--camera");
  split = split || !options_.split.empty();
  splitting.way = options_.splitWay.value_or(splitting.way);
  if (!options_.splitBackend.empty()) splitting.backend = options_.splitBackend;
  beginComparing();
  for (auto [wanted, view] : {std::pair{&options_.view, &left}, {&options_.split, &right}}) {
    if (wanted->empty()) continue;
    *view = *wanted;
    checkViews();
    if (*view != *wanted) {
      throw Error(ErrorId::kOutputUnknown, "there is no output '{}' to show", *wanted);
    }
  }
  const ObjectOptions objects{.loads = options_.loads, .adds = {}, .saves = {}};
  objects.check(chain);
  objects.load(chain);
}

// First come the effects that the settings name, else those that run by default. They are on;
// presets override defaults, and the settings' values override presets. The other effects are off
// and keep order and values.
void Session::apply(const Settings& settings, const std::vector<std::string>& presets) {
  effect::Selection fresh = chosenEffects(
      *registry_, settings.effects ? *settings.effects : registry_->defaults(), presets, settings);
  for (effect::Selection::Entry entry : chain.selection.entries()) {
    if (fresh.find(entry.key()) != nullptr) continue;
    entry.on = false;
    fresh.entries().push_back(entry);
  }
  chain.selection = std::move(fresh);
  fitToScene();
}

// Lengths that nobody has set follow the scene.
void Session::fitToScene() {
  fitLengths(chain.selection, suitableRadius_);
  if (held) fitLengths(*held, suitableRadius_);
}

void Session::resetParameter(effect::Selection::Entry& entry, const std::string& key) {
  entry.values.reset(key);
  changed(fmt::format("{}.{}", entry.key(), key));
}

void Session::setScene(std::shared_ptr<scene::Scene> loaded, const std::string& path,
                       glm::uvec2 size) {
  scenePath = path;
  posed_ = std::move(loaded);
  scene = posed_;
  playback = {};
  services = std::make_unique<SceneServices>(
      *scene, [this](const std::string& file, const std::string& warning) { warn(file, warning); });
  // Found while this thread looks for a camera.
  constexpr uint32_t kFarSides =
      GRISAILLE_READS(GRISAILLE_BACK_DEPTH) | GRISAILLE_READS(GRISAILLE_NEXT_DEPTH);
  if (reads(kFarSides | GRISAILLE_READS(GRISAILLE_THICKNESS))) services->matter().prepare();
  if (reads(kFarSides)) services->matter().prepareBuried();
  for (const std::string& note : scene->notes) say("note: " + note);
  aspect_ = double{1} * std::max(size.x, 1u) / std::max(size.y, 1u);
  const bool first = std::exchange(firstScene_, false);
  homeGiven_ = first && !options_.camera.empty();
  homeCamera = homeGiven_ ? camera : scene::defaultCamera(*scene, aspect_);
  camera = homeCamera;
  extent = glm::length(scene->bounds.max - scene->bounds.min);
  suitableRadius_ = suitableRadius(*scene);
  fitToScene();
  ++revision;
  ++heldRevision;
  zoom = 1;
  centre = glm::vec2(0.5f);
  if (first) {
    attempt("pose", [&] {
      const scene::Pose pose = options_.pose.poseOf(*scene);
      choose(pose.animation);
      takePose(pose);
    });
  }
  arrive();
  cameraHistory.begin(camera);
}

// Whether the first frame will read one of the attachments. If this is wrong, that frame is only
// later.
bool Session::reads(uint32_t attachments) const {
  return std::ranges::any_of(chain.selection.entries(), [&](const effect::Selection::Entry& entry) {
    return entry.on && (entry.effect().reads(entry.values.all().data(), ~0u) & attachments) != 0;
  });
}

void Session::goTo(const scene::Camera& next) {
  cameraHistory.note(camera);
  jumpTo(next);
}

void Session::jumpTo(const scene::Camera& next) {
  camera = next;
  ++jumps_;
}

void Session::findSurfaces() {
  if (scene && scene::triangleCount(*scene) <= kMostTriangles) services->rays().prepare();
}

bool Session::isFree(const glm::dvec3& from, const glm::dvec3& to, double clearance) {
  const double length = glm::length(to - from);
  if (!services || !services->rays().isReady() || !(length > 0)) return true;
  const glm::vec3 unit((to - from) / length);
  const grisaille_ray ray = {.origin = {from.x, from.y, from.z},
                             .direction = {unit.x, unit.y, unit.z},
                             .reach = static_cast<float>(length + clearance)};
  grisaille_hit hit = {};
  services->rays().cast(std::span(&ray, 1), std::span(&hit, 1));
  return hit.kind != GRISAILLE_HIT_SURFACE;
}

void Session::noteChanges() {
  if (lastChange_.empty()) return;
  history.noteSettings(chain.state(), std::exchange(lastChange_, {}));
}

void Session::undo() {
  noteChanges();
  history.undo();
  checkViews();
}

void Session::redo() {
  noteChanges();
  history.redo();
  checkViews();
}

void Session::rescan(const std::function<void()>& before) {
  auto fresh = loadEffects(options_.pluginPaths);
  std::optional<effect::Selection> heldAgain;
  if (held) heldAgain.emplace(*fresh).restore(held->state());
  before();
  const std::vector<std::string> dropped = chain.rebind(*fresh);
  held = std::move(heldAgain);
  next_.clear();
  registry_ = std::move(fresh);
  fitToScene();
  ++revision;
  ++heldRevision;
  loadAllPresets();
  checkViews();
  for (const std::string& one : dropped) say(one);
  history.noteSettings(chain.state(), "rescan");
}

void Session::hold() {
  held = chain.selection;
  ++heldRevision;
}

void Session::swapHeld() {
  if (!held) return;
  std::swap(*held, chain.selection);
  ++heldRevision;
  changed("swap");
  checkViews();
}

std::vector<Viewable> Session::views(bool rightSide) const {
  std::vector<Viewable> all = viewables(rightSide && held ? *held : chain.selection);
  if (!comparedOutput().empty()) {
    all.push_back({std::string(kErrorView), "Error against truth", Kind::kEncoded});
    all.push_back({std::string(kTruthView), "Truth", Kind::kNumber});
  }
  return all;
}

void Session::checkViews() {
  for (auto [view, rightSide] : {std::pair{&left, false}, {&right, true}}) {
    const std::vector<Viewable> all = views(rightSide);
    if (std::ranges::find(all, *view, &Viewable::output) == all.end()) *view = "color";
  }
}

void Session::openFile(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".toml") return loadSettings(path);
  if (ending == ".json") {
    const std::string owner = ownerOf(path);
    if (!owner.empty()) return loadObjects(owner, path);
    camera = scene::loadCamera(path);
    return;
  }
  throw Error(ErrorId::kFileUnknown, "the viewer cannot open '{}'", path);
}

void Session::loadSettings(const std::string& path) {
  const Settings settings = readSettings(path);
  apply(settings, {});
  if (settings.surface) surface = surfaceOf(*settings.surface);
  if (settings.background) background = backgroundOf(*settings.background).value_or(background);
  changed(fs::path(path).filename().string());
  checkViews();
  say("settings from " + path);
}

void Session::saveSettings(const std::string& path) {
  Settings settings = settingsOf(chain.selection);
  settings.surface = nameOf(surface);
  settings.background = textOf(background);
  writeSettings(settings, path);
  say("settings to " + path);
}

std::string Session::rescue(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);  // on failure, saving throws
  std::vector<std::string> words = {"grisaille", "view"};
  const std::string& path = scene ? scenePath : options_.scene;  // maybe not loaded yet
  if (!path.empty()) words.push_back(plainPath(path));
  const std::vector<std::string> pose = poseArguments(playback.pose);
  words.insert(words.end(), pose.begin(), pose.end());
  const auto keep = [&](const char* option, const std::string& prefix, const fs::path& file) {
    words.insert(words.end(), {option, prefix + file.string()});
    return file.string();
  };
  saveSettings(keep("--config", "", folder / "settings.toml"));
  for (const auto& [effect, list] : chain.objectLists()) {
    if (list.size() == 0) continue;
    objects::save(list.view(), keep("--load", effect + "=", folder / (effect + ".json")));
  }
  if (scene) scene::saveCamera(camera, keep("--camera", "", folder / "camera.json"));
  for (const std::string& plugins : options_.pluginPaths) {
    words.insert(words.end(), {"--plugin-path", plainPath(plugins)});
  }
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + shellQuoted(word);
  return command;
}

void Session::add(Message message) {
  messages.push_back(std::move(message));
  if (messages.size() > kMessagesKept) messages.pop_front();
}

// Removes the error about something that has been tried again.
void Session::forget(const std::string& about) {
  std::erase_if(messages, [&](const Message& one) { return one.error && one.about == about; });
}

void Session::warn(const std::string& file, const std::string& text) {
  const std::string about = "file " + file;
  forget(about);
  if (!text.empty()) add({"warning: " + text, true, about});
}

bool Session::attempt(const std::string& about, const std::function<void()>& action) {
  std::string failure;
  try {
    action();
  } catch (const Error& error) {
    if (error.id() == ErrorId::kDeviceLost) throw;  // no further frame is possible
    failure = error.what();
  } catch (const fs::filesystem_error& error) {
    failure = Error(ErrorId::kFileUnwritable, "{}", error.what()).what();
  }
  conclude(about, failure);
  return failure.empty();
}

void Session::conclude(const std::string& about, const std::string& failure) {
  forget(about);
  if (!failure.empty()) add({failure, true, about});
}

}  // namespace grisaille::app::viewer
