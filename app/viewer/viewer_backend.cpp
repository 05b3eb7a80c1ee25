// SPDX-License-Identifier: MIT
// The viewer's backends: the one of the window, which the user can change, and the one that may
// render the right side of a split picture.
#include <algorithm>
#include <filesystem>

#include "app/viewer/viewer.h"

namespace grisaille::app::viewer {

// Opens the window with the requested backend, else with the first that starts.
void Viewer::openWindow() {
  if (!options_.backend.empty()) {
    take(open(backends::find(options_.backend)), options_.backend);
    return;
  }
  std::vector<backends::Backend> order(backends::all().begin(), backends::all().end());
  std::stable_partition(order.begin(), order.end(), [&](const backends::Backend& backend) {
    return last_ && last_->backend == backend.name;
  });
  std::string reasons;
  for (const backends::Backend& backend : order) {
    try {
      take(open(backend), backend.name);
      if (!reasons.empty()) session_.say(reasons, true);
      return;
    } catch (const Error& error) {
      reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", backend.name, error.detail());
    }
  }
  throw Error(ErrorId::kNoDevice, "no backend opens a window: {}", reasons);
}

gpu::DeviceOptions Viewer::deviceOptions(const std::string& backend) const {
  gpu::DeviceOptions options;
  if (firstBackend_.empty() || backend == firstBackend_) options.device = options_.device;
  options.check = options_.check;
  options.message = options_.message;
  return options;
}

std::string Viewer::deviceName() const {
  return deviceOptions(backend_).device;
}

Viewer::Opened Viewer::open(const backends::Backend& backend) {
  Opened opened;
  opened.window =
      std::make_unique<Window>(backend, options_.check, glm::uvec2(state_.width, state_.height));
  gpu::DeviceOptions options = deviceOptions(backend.name);
  options.timed = true;
  options.window = opened.window->surface();
  opened.device = backends::create(backend.name, options);
  return opened;
}

// Replaces window and device. Everything on the old device ends; what is traced stays.
void Viewer::take(Opened opened, const std::string& backend) {
  stage_.reset();
  other_.reset();
  difference_.reset();
  screen_.reset();
  apart_.reset();
  shown_ = {};
  retry_ = {};
  times_.clear();
  if (truth_) truth_->moveTo(*opened.device);
  device_ = std::move(opened.device);
  window_ = std::move(opened.window);
  backend_ = backend;
  if (firstBackend_.empty()) firstBackend_ = backend;
  if (!truth_) truth_ = std::make_unique<TruthView>(*device_);
  screen_ = std::make_unique<Screen>(*device_);
  difference_ = std::make_unique<SideDifference>(*device_);
  if (session_.scene) {
    stage_ = std::make_unique<Stage>(*device_, *session_.scene, *session_.services, session_.chain);
    nameWindow();
  }
  const gpu::DeviceInfo& info = device_->info();
  fmt::print("{}: {} ({}){}\n", info.backend, info.name, info.driver,
             info.software ? ", software" : "");
  std::fflush(stdout);
}

// Opens a window of another backend in place of this one. If that fails, nothing has changed.
void Viewer::changeBackend(const std::string& backend) {
  const std::string before = backend_;
  if (backend == before) return;
  const bool full = window_->isFullScreen();
  noteSize();
  const glm::ivec2 position = window_->position();
  Opened opened = open(backends::find(backend));
  if (!full) opened.window->moveTo(position);
  take(std::move(opened), backend);
  if (full) window_->toggleFullScreen();
  // A right side of the new backend now is one of the old backend: the sides still differ.
  if (session_.splitting.backend == backend) session_.splitting.backend = before;
  session_.say(fmt::format("{} now draws the window", backends::find(backend).label));
  settle_ = kSettleFrames;
}

void Viewer::nameWindow() {
  const std::string scene = session_.scenePath.empty()
                                ? "atrium"
                                : std::filesystem::path(session_.scenePath).filename().string();
  const gpu::DeviceInfo& info = device_->info();
  window_->setTitle(fmt::format("{} - Grisaille - {} on {}{}", scene,
                                backends::find(backend_).label, info.name,
                                info.software ? " (software)" : ""));
}

std::optional<StageDesc> Viewer::otherDesc() {
  const std::string& backend = session_.splitting.backend;
  if (!session_.split || backend.empty() || backend == backend_) return std::nullopt;
  if (isTruthView(session_.right)) return std::nullopt;
  StageDesc desc = commonDesc();
  // Revisions of held and of live settings must differ.
  desc.liveRevision =
      2 * (session_.held ? session_.heldRevision : session_.revision) + (session_.held ? 1 : 0);
  desc.poses = session_.scene ? session_.scene->poses : 0;
  desc.left = session_.right;
  desc.patience = placingPatience();
  return desc;
}

bool Viewer::isOtherStale() {
  const std::optional<StageDesc> desc = otherDesc();
  if (!desc || !stage_) return false;
  if (!other_ || other_->backend() != session_.splitting.backend) return true;
  const effect::Selection& effects = session_.held ? *session_.held : session_.chain.selection;
  return other_->isStale(*session_.scene, *desc, effects);
}

// If the other backend fails, the window's renders the right side again.
void Viewer::updateOther() {
  const std::optional<StageDesc> desc = otherDesc();
  if (!desc) {
    other_.reset();
    return;
  }
  const std::string backend = session_.splitting.backend;
  std::string failure;
  try {
    if (!other_ || other_->backend() != backend) {
      other_.reset();
      other_ = std::make_unique<OtherBackend>(backend, deviceOptions(backend), *device_);
    }
    other_->update(*session_.scene, *session_.services, *desc,
                   session_.held ? *session_.held : session_.chain.selection);
  } catch (const Error& error) {
    failure = error.what();
  }
  if (failure.empty()) return;
  other_.reset();
  session_.splitting.backend.clear();
  session_.say(fmt::format("the right side on {}: {}", backend, failure), true);
}

}  // namespace grisaille::app::viewer
