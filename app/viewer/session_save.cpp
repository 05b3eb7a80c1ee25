// SPDX-License-Identifier: MIT
// The session's file: what it saves, and how it takes another one over.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/settings/background.h"
#include "app/viewer/session.h"
#include "core/objects/object_file.h"
#include "core/scene/built_in.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

bool same(const objects::View& a, const objects::View& b) {
  size_t i = 0;
  while (i < a.count && i < b.count && a.object(i) == b.object(i)) ++i;
  return i == a.count && i == b.count;
}

}  // namespace

std::string sceneKey(const std::string& path) {
  if (const scene::BuiltIn* builtIn = scene::findBuiltIn(path)) return builtIn->name;
  std::error_code failed;
  return fs::absolute(path, failed).lexically_normal().string();
}

SavedSession Session::saved() {
  SavedSession session;
  session.scene = sceneKey(scene ? scenePath : options_.scene);
  if (scene) {
    session.camera = camera;
    session.pose = playback.pose;
  } else if (arrival_ && arrival_->scene == session.scene) {
    session.camera = arrival_->camera;
    session.pose = arrival_->pose;
  }
  session.effects = chain.state();
  if (held) session.held = held->state();
  session.objects = strangeObjects_;
  for (const effect::Selection::State::One& one : session.effects.effects) {
    const objects::ObjectList* list = chain.objectsEvenIfAbsent(one.key);
    if (list != nullptr && list->size() > 0)
      session.objects[one.key] = objects::jsonOf(list->view());
  }
  session.surface = surface == frame::Surface::kBaseColour ? "base" : "white";
  session.background = textOf(background);
  session.left = left;
  session.right = right;
  session.split = split;
  session.line = line;
  session.splitting = splitting;
  session.fineness = fineness;
  session.comparing = comparing;
  session.inspecting = inspecting;
  session.sequence = sequence;
  return session;
}

// Takes effects, objects, camera and pose of the last session, before the options are applied.
void Session::resume(const SavedSession& last, bool sameScene) {
  for (const std::string& dropped : chain.restore(last.effects)) say(dropped);
  if (!sameScene) return;
  takeObjects(last, false);
  arrival_ = {.scene = sceneKey(last.scene), .camera = {}, .pose = {}};
  if (options_.scene.empty()) options_.scene = last.scene;
  if (options_.camera.empty()) arrival_->camera = last.camera;
  if (!options_.pose.given()) arrival_->pose = last.pose;
}

// The effects, presets and values of the command line, over those of the last session.
void Session::applyGiven() {
  effect::Selection& selection = chain.selection;
  if (options_.effectsGiven) {
    const effect::Selection named(*registry_, options_.effects);  // checks the keys
    for (effect::Selection::Entry& entry : selection.entries()) entry.on = false;
    size_t place = 0;
    for (const effect::Selection::Entry& one : named.entries()) {
      const auto* entry = selection.find(one.key());
      selection.move(static_cast<size_t>(entry - selection.entries().data()), place);
      selection.entries()[place++].on = true;
    }
  }
  applyPresets(options_.presets, selection);
  for (const std::string& text : options_.sets) selection.set(effect::parseAssignment(text));
  fitToScene();
}

void Session::takeViews(const SavedSession& session) {
  left = session.left;
  right = session.right;
  split = session.split;
  line = session.line;
  splitting = session.splitting;
  fineness = session.fineness;
  inspecting = session.inspecting;
  comparing = session.comparing;
  sequence = session.sequence;
  held.reset();
  if (session.held) {
    held.emplace(*registry_).restore(*session.held);
    fitToScene();
  }
  ++heldRevision;
  checkViews();
}

// `undoable`: each list is a step of undo. Lists that no loaded effect takes are kept as text.
void Session::takeObjects(const SavedSession& session, bool undoable) {
  strangeObjects_.clear();
  for (const auto& [effect, text] : session.objects) {
    const auto& options = options_.loads;
    if (!undoable && std::ranges::any_of(options, [&, key = effect + "="](const std::string& load) {
          return load.starts_with(key);
        })) {
      continue;
    }
    objects::ObjectList* list = chain.objects(effect);
    const bool taken =
        list != nullptr && attempt("objects of the session", [&, key = effect, &text = text] {
          objects::Objects all = objects::parse(list->table(), text, "the session's " + key);
          if (!undoable) return list->assign(std::move(all));
          if (same(all.view(), list->view())) return;
          changeObjects(key, "session", false,
                        [&](objects::ObjectList& own) { own.replace(std::move(all)); });
        });
    if (!taken) strangeObjects_[effect] = text;
  }
  if (!undoable) return;
  // Lists that the session does not have are empty there.
  for (const std::string& effect : effectsWithObjects()) {
    if (!session.objects.contains(effect) && listOf(effect).size() > 0) clearObjects(effect);
  }
}

// Goes to the camera and the pose of a session, once its scene is here.
void Session::arrive() {
  if (!arrival_ || !scene || arrival_->scene != sceneKey(scenePath)) return;
  const Arrival arrival = *std::exchange(arrival_, {});
  attempt("pose", [&] {
    const scene::Pose& pose = arrival.pose;
    if (pose.animation && *pose.animation >= animationsOf(*scene).size()) {
      throw Error(ErrorId::kSceneAnimation, "the scene has no animation {}", *pose.animation);
    }
    if (!pose.animation) return;
    choose(pose.animation);
    seek(pose.seconds);
  });
  if (arrival.camera) camera = *arrival.camera;
}

bool Session::open(const SavedSession& session) {
  noteChanges();
  for (const std::string& dropped : chain.restore(session.effects)) say(dropped);
  changed("session");
  noteChanges();
  takeObjects(session, true);
  surface = session.surface == "base" ? frame::Surface::kBaseColour : frame::Surface::kWhite;
  background = backgroundOf(session.background).value_or(background);
  takeViews(session);
  fitToScene();
  ++revision;
  arrival_ = {.scene = sceneKey(session.scene), .camera = session.camera, .pose = session.pose};
  if (!scene || sceneKey(scenePath) != arrival_->scene) return true;
  attempt("pose", [&] { choose({}); });
  const scene::Camera before = camera;
  arrive();
  cameraHistory.note(before);
  return false;
}

}  // namespace grisaille::app::viewer
