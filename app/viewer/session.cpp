// SPDX-License-Identifier: MIT
#include "app/viewer/session.h"
#include "app/options/camera_option.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/viewer/camera_control.h"
#include "app/viewer/command_line.h"
#include "app/viewer/state_file.h"
#include "core/base/quote.h"
#include "core/base/regular_file.h"
#include "core/shots/shot_file.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

frame::Surface surfaceOf(const std::string& name) {
  return name == "base" ? frame::Surface::kBaseColour : frame::Surface::kWhite;
}

const char* nameOf(frame::Surface surface) {
  return surface == frame::Surface::kBaseColour ? "base" : "white";
}

// What the command line asks of the effects, as render has it.
EffectList asked(const effect::Registry& registry, const SessionOptions& options,
                 const Settings& settings) {
  EffectList list(registry);
  Settings all = settings;
  if (options.effectsGiven) all.effects = options.effects;
  for (const std::string& text : options.sets) {
    const size_t dot = text.find('.'), equals = text.find('=');
    if (dot == std::string::npos || equals == std::string::npos || equals < dot) {
      throw Error(ErrorId::kUsage, "'{}' is not of the form EFFECT.PARAMETER=VALUE", text);
    }
    all.values.push_back({.effect = text.substr(0, dot),
                          .key = text.substr(dot + 1, equals - dot - 1),
                          .text = text.substr(equals + 1),
                          .place = "--set"});
  }
  list.apply(all, options.presets);
  return list;
}

// What a .json file holds: "shots" or "eye", whichever comes first.
bool holdsShots(const std::string& path) {
  std::ifstream file = openRegularFile(path, ErrorId::kShotFileUnreadable);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  const size_t eye = head.find("\"eye\"");
  return eye == std::string::npos || head.find("\"shots\"") < eye;
}

}  // namespace

Session::Session(SessionOptions options)
    : registry_(loadEffects(options.pluginPaths)),
      effects(*registry_),
      history(
          effects.state(),
          [this](const EffectList::State& state) {
            for (const std::string& dropped : effects.restore(state)) say(dropped);
            ++revision;
          },
          [this](std::string_view effect) -> shots::ShotList& {
            return shots.find(effect)->second;
          }),
      options_(std::move(options)) {
  const Settings settings = options_.config.empty() ? Settings{} : readSettings(options_.config);
  effects = asked(*registry_, options_, settings);
  history.noteSettings(effects.state(), "command line");
  loadAllPresets();
  surface =
      surfaceOf(!options_.surface.empty() ? options_.surface : settings.surface.value_or("white"));
  if (!options_.camera.empty()) camera = cameraOf(options_.camera, "--camera");
  split = !options_.split.empty();
  beginComparing();
  for (auto [wanted, view] : {std::pair{&options_.view, &left}, {&options_.split, &right}}) {
    if (wanted->empty()) continue;
    *view = *wanted;
    checkViews();
    if (*view != *wanted) {
      throw Error(ErrorId::kOutputUnknown, "there is no output '{}' to look at", *wanted);
    }
  }
  addLists();
  for (const std::string& load : options_.loads) {
    const size_t equals = load.find('=');
    const auto list = shots.find(load.substr(0, equals));
    if (equals == std::string::npos || list == shots.end()) {
      throw Error(ErrorId::kUsage,
                  "'{}' is not of the form EFFECT=FILE with an effect that takes "
                  "shots",
                  load);
    }
    list->second.fire(shots::load(load.substr(equals + 1)));
  }
}

void Session::addLists() {
  for (const EffectList::Entry& entry : effects.entries()) {
    if (entry.values.effect().takesShots()) shots.try_emplace(entry.key());
  }
}

void Session::setScene(std::shared_ptr<const scene::Scene> loaded, const std::string& path) {
  scenePath = path;
  scene = std::move(loaded);
  homeCamera = path.empty() ? scene::atriumCamera() : scene::overviewCamera(scene->bounds);
  if (std::exchange(firstScene_, false) && !options_.camera.empty()) homeCamera = camera;
  camera = homeCamera;
  speed = flySpeed(scene->bounds);
  zoom = 1;
  centre = glm::vec2(0.5f);
}

void Session::noteChanges() {
  if (lastChange_.empty()) return;
  history.noteSettings(effects.state(), std::exchange(lastChange_, {}));
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
  std::vector<std::string> dropped;
  EffectList list = EffectList::rebound(effects, *fresh, dropped);
  std::optional<EffectList> heldList;
  if (held) heldList = EffectList::rebound(*held, *fresh, dropped);
  before();
  effects = std::move(list);
  held = std::move(heldList);
  registry_ = std::move(fresh);
  ++revision;
  ++heldRevision;
  loadAllPresets();
  addLists();
  checkViews();
  for (const std::string& one : dropped) say(one);
  history.noteSettings(effects.state(), "rescan");
}

void Session::hold() {
  held = effects;
  ++heldRevision;
}

void Session::swapHeld() {
  if (!held) return;
  std::swap(*held, effects);
  ++heldRevision;
  changed("swap");
  checkViews();
}

std::vector<Viewable> Session::views(bool rightSide) const {
  std::vector<Viewable> all = viewables(rightSide && held ? *held : effects);
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

std::string Session::painter() const {
  for (const EffectList::Entry& entry : effects.entries()) {
    if (entry.on && entry.values.effect().takesShots()) return entry.key();
  }
  return "";
}

void Session::fire(glm::dvec2 point, glm::uvec2 size, bool joins) {
  const std::string effect = painter();
  if (effect.empty()) {
    throw Error(ErrorId::kEffectTakesNoShots, "no effect that is on takes shots");
  }
  const glm::vec3 unit(glm::normalize(scene::pixelDirection(camera, size.x, size.y, point)));
  shots.find(effect)->second.fire({.origin = {camera.eye.x, camera.eye.y, camera.eye.z},
                                   .direction = {unit.x, unit.y, unit.z},
                                   .color = {color.x, color.y, color.z},
                                   .range = 0,
                                   .reserved = 0});
  noteChanges();
  history.noteShots(effect, 1, joins ? "spray" : "shot", joins);
}

void Session::clearShots() {
  const std::string effect = painter();
  if (effect.empty() || shots.find(effect)->second.shots().empty()) return;
  shots.find(effect)->second.clear();
  noteChanges();
  history.noteShots(effect, 1, "clear");
}

void Session::loadShots(const std::string& path) {
  const std::string effect = painter();
  if (effect.empty()) {
    throw Error(ErrorId::kEffectTakesNoShots, "{}: no effect that is on takes shots", path);
  }
  const auto loaded = shots::load(path);
  shots::ShotList& list = shots.find(effect)->second;
  if (loaded.empty() && list.shots().empty()) return;
  list.replace(loaded);
  noteChanges();
  history.noteShots(effect, 1, "load shots");
  say(fmt::format("{} shots from {}", loaded.size(), path));
}

void Session::saveShots(const std::string& path) {
  const std::string effect = painter();
  if (effect.empty()) throw Error(ErrorId::kEffectTakesNoShots, "no effect that is on takes shots");
  const auto all = shots.find(effect)->second.shots();
  shots::save(all, path);
  say(fmt::format("{} shots to {}", all.size(), path));
}

void Session::openFile(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".toml") return loadSettings(path);
  if (ending == ".shots" || (ending == ".json" && holdsShots(path))) return loadShots(path);
  if (ending == ".json") {
    camera = scene::loadCamera(path);
    return;
  }
  throw Error(ErrorId::kFileUnknown, "what '{}' holds is unknown", path);
}

void Session::loadSettings(const std::string& path) {
  const Settings settings = readSettings(path);
  effects.apply(settings);
  if (settings.surface) surface = surfaceOf(*settings.surface);
  changed(fs::path(path).filename().string());
  checkViews();
  say("settings from " + path);
}

void Session::saveSettings(const std::string& path) {
  Settings settings = effects.settings();
  settings.surface = nameOf(surface);
  writeSettings(settings, path);
  say("settings to " + path);
}

std::string Session::rescue(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);  // else the next line says so
  std::vector<std::string> words = {"grisaille", "view"};
  const std::string& path = scene ? scenePath : options_.scene;  // that was being read
  if (!path.empty()) words.push_back(plainPath(path));
  const auto keep = [&](const char* option, const std::string& prefix, const fs::path& file) {
    words.insert(words.end(), {option, prefix + file.string()});
    return file.string();
  };
  saveSettings(keep("--config", "", folder / "settings.toml"));
  for (const auto& [effect, list] : shots) {
    if (list.shots().empty()) continue;
    shots::save(list.shots(), keep("--load", effect + "=", folder / (effect + ".shots")));
  }
  if (scene) scene::saveCamera(camera, keep("--camera", "", folder / "camera.json"));
  for (const std::string& plugins : options_.pluginPaths) {
    words.insert(words.end(), {"--plugin-path", plainPath(plugins)});
  }
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + shellQuoted(word);
  return command;
}

std::string Session::commandLine(glm::uvec2 size, const std::string& backend,
                                 const std::string& device) {
  RenderCommand command;
  command.scene = scenePath;
  command.camera = camera;
  command.size = size;
  command.backend = backend;
  command.device = device;
  command.effects = &effects;
  command.surface = nameOf(surface);
  command.pluginPaths = options_.pluginPaths;
  const std::string effect = painter();
  if (!effect.empty() && !shots.find(effect)->second.shots().empty()) {
    // Named by what it holds: a command that was copied earlier keeps its shots.
    const auto all = std::as_bytes(shots.find(effect)->second.shots());
    const size_t hash =
        std::hash<std::string_view>()({reinterpret_cast<const char*>(all.data()), all.size()});
    const fs::path file = stateFolder() / fmt::format("{}-{:016x}.shots", effect, hash);
    fs::create_directories(stateFolder());
    shots::save(shots.find(effect)->second.shots(), file.string());
    command.loads.emplace_back(effect, file.string());
  }
  command.writes.emplace_back(isTruthView(left) ? comparedOutput() : left, "grisaille.png");
  return renderCommand(command);
}

void Session::say(std::string text, bool error) {
  messages.push_back({std::move(text), error});
  if (messages.size() > kMessagesKept) messages.pop_front();
}

void Session::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    if (error.id() == ErrorId::kDeviceLost) throw;  // nothing more is drawn
    say(error.what(), true);
  } catch (const fs::filesystem_error& error) {
    say(Error(ErrorId::kFileUnwritable, "{}", error.what()).what(), true);
  }
}

}  // namespace grisaille::app::viewer
