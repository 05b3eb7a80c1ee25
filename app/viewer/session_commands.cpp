// SPDX-License-Identifier: MIT
// The session's `grisaille render` commands: of the picture on the screen, and of a sequence.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/settings/background.h"
#include "app/viewer/session.h"
#include "app/viewer/state_file.h"
#include "core/base/atomic_file.h"
#include "core/objects/object_file.h"
#include "core/scene/camera_path.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

// Writes a file that a command names, and returns its path. A hash of the content is part of its
// name: commands copied earlier keep their files.
std::string kept(const std::string& name, const std::string& text) {
  const fs::path file =
      stateFolder() / fmt::format("{}-{:016x}.json", name, std::hash<std::string>()(text));
  fs::create_directories(stateFolder());
  writeFileAtomically(file.string(), text);
  return file.string();
}

}  // namespace

RenderCommand Session::command(glm::uvec2 size, const std::string& backend,
                               const std::string& device) {
  RenderCommand command;
  command.scene = scenePath;
  command.pose = poseArguments(playback.pose);
  command.camera = camera;
  command.size = size;
  command.backend = backend;
  command.device = device;
  command.effects = &chain.selection;
  command.surface = surface == frame::Surface::kBaseColour ? "base" : "white";
  if (background != frame::kGrey) command.background = textOf(background);
  command.pluginPaths = options_.pluginPaths;
  for (const std::string& effect : effectsWithObjects()) {
    const objects::ObjectList& list = listOf(effect);
    if (list.size() == 0) continue;
    command.loads.emplace_back(effect, kept(effect, objects::jsonOf(list.view())));
  }
  return command;
}

std::string Session::shownOutput() const {
  return isTruthView(left) ? comparedOutput() : left;
}

std::string Session::commandLine(glm::uvec2 size, const std::string& backend,
                                 const std::string& device) {
  RenderCommand all = command(size, backend, device);
  all.writes.emplace_back(shownOutput(), "grisaille.png");
  return renderCommand(all);
}

double Session::sequenceSeconds() const {
  return sequence.animated && hasAnimations() ? duration() : sequence.seconds;
}

uint32_t Session::sequenceFrames() const {
  const double steps = std::floor(sequenceSeconds() * Playback::kFrames + kWithin);
  return static_cast<uint32_t>(std::clamp(steps + 1, 2.0, double{scene::kMostPathFrames}));
}

RenderCommand Session::sequenceCommand(glm::uvec2 size, const std::string& backend,
                                       const std::string& device) {
  const bool animated = sequence.animated && hasAnimations();
  if (sequence.keys.size() == 1 || (sequence.keys.empty() && !animated)) {
    throw Error(ErrorId::kUsage,
                "a sequence needs two cameras or more, or an animation: add cameras to the path");
  }
  RenderCommand all = command(size, backend, device);
  if (!sequence.keys.empty()) {
    all.path = kept("path", scene::cameraPathJson({sequence.keys, sequenceFrames()}));
  }
  if (animated) {
    all.pose = {"--animation", fmt::format("{}", playback.pose.animation.value_or(0))};
    all.times =
        fmt::format("0:{}:1/{}", (sequenceFrames() - 1) / Playback::kFrames, Playback::kFrames);
  }
  all.writes.emplace_back(shownOutput(), sequence.file);
  if (sequence.filmed) all.video = sequence.video;
  return all;
}

void Session::previewSequence(bool on) {
  preview_.reset();
  if (!on || sequence.keys.size() < 2) return;
  cameraHistory.note(camera);
  preview_ = 0;
}

// Moves the camera along the path, and the animation with it.
void Session::advancePreview(double seconds) {
  if (!preview_) return;
  const double whole = sequenceSeconds();
  *preview_ = std::min(*preview_ + seconds, whole);
  const double share = whole > 0 ? *preview_ / whole : 1;
  const bool good = sequence.keys.size() >= 2 && attempt("preview", [&] {
                      camera = scene::cameraAt(sequence.keys, share);
                      if (sequence.animated) seek(*preview_);
                    });
  if (share >= 1 || !good) preview_.reset();
}

}  // namespace grisaille::app::viewer
