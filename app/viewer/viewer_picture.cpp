// SPDX-License-Identifier: MIT
// What the viewer puts into its window, and into files.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "app/viewer/viewer.h"
#include "core/frame/texture_image.h"
#include "core/image/write_aside.h"

namespace grisaille::app::viewer {
namespace {

// "20261121-143000".
std::string timeStamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &local);
  return text.data();
}

std::string fileName(std::string output) {
  std::ranges::replace(output, '.', '-');
  return fmt::format("grisaille-{}-{}", timeStamp(), output);
}

std::optional<Painter> painterOf(const EffectList& list) {
  std::vector<const effect::Effect*> effects;
  for (const EffectList::Entry& entry : list.entries()) {
    if (entry.on) effects.push_back(&entry.values.effect());
  }
  return findPainter(effects);
}

}  // namespace

Place Viewer::place() const {
  const glm::uvec2 pixels = window_->pixels();
  const glm::uvec2 size = window_->size();
  const float scale = size.x > 0 ? static_cast<float>(pixels.x) / static_cast<float>(size.x) : 1;
  const auto left =
      std::min(static_cast<uint32_t>(std::lround(panel_.width(glm::vec2(size)) * scale)), pixels.x);
  return {.corner = {static_cast<int>(left), 0}, .size = {pixels.x - left, pixels.y}};
}

StageDesc Viewer::stageDesc() const {
  StageDesc desc;
  desc.camera = session_.camera;
  desc.size = place().size;
  desc.surface = session_.surface;
  desc.live = &session_.effects;
  desc.liveRevision = session_.revision;
  desc.left = session_.left;
  if (session_.split) {
    desc.right = session_.right;
    if (session_.held) {
      desc.held = &*session_.held;
      desc.heldRevision = session_.heldRevision;
    }
  }
  desc.shots = &session_.shots;
  // Where a frame takes long anyway, paint may take as long: it is whole sooner.
  desc.patience = std::clamp(updateSeconds_, 0.03, 0.3);
  if (panel_.wantsCoverage) {
    if (const auto painter = painterOf(session_.effects)) {
      desc.extra = {painter->owner, painter->paint, "depth", "facet_normal"};
    }
  }
  return desc;
}

void Viewer::updateStage() {
  if (!stage_) return;
  const StageDesc desc = stageDesc();
  if (session_.paused && !session_.step) return;
  session_.step = false;
  if (desc.size.x == 0 || desc.size.y == 0) return;
  if (session_.continuous) stage_->touch();
  if (!stage_->isStale(desc)) return;
  session_.attempt([&] {
    const Clock::time_point start = Clock::now();
    stage_->update(desc);
    updateSeconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    if (panel_.wantsCoverage) updateCoverage();
  });
  settle_ = std::max(settle_, 1);  // what is said of it
}

void Viewer::updateCoverage() {
  const auto painter = painterOf(session_.effects);
  if (!painter) return;
  coverage_ = colorShares(stage_->read(painter->owner), stage_->read(painter->paint),
                          stage_->read("depth"), stage_->read("facet_normal"), session_.camera,
                          session_.shots.find(painter->effect)->second.shots());
}

Status Viewer::status() {
  for (const gpu::FrameTimes& frame : device_->takeTimes()) {
    const bool own = std::ranges::all_of(
        frame.passes, [](const gpu::PassTime& pass) { return pass.label.starts_with("viewer/"); });
    if (!own) times_.add(frame);
  }
  Status status;
  status.device = device_->info();
  status.passes = times_.all();
  status.whole = times_.whole();
  status.coverage = coverage_;
  status.picture = place().size;
  status.waiting = stage_ ? stage_->waiting() : 0;
  if (loading_.running()) {
    status.loading = loading_.progress();
    status.loadingPath = loading_.path().empty() ? "built-in atrium" : loading_.path();
  }
  status.rebuilding = rebuild_.building();
  status.buildMessage = buildMessage_;
  const auto texel = controls_.texel(place());
  if (session_.inspecting && stage_ && texel) {
    session_.attempt([&] {
      status.cursorTexel = *texel;
      status.cursorValue = stage_->valueAt(controls_.rightSide(place()), glm::uvec2(*texel));
    });
  }
  return status;
}

void Viewer::drawWindow() {
  ScreenDesc desc;
  desc.pixels = window_->pixels();
  if (desc.pixels.x == 0 || desc.pixels.y == 0) return;
  desc.place = place();
  desc.stage = stage_.get();
  desc.split = session_.split;
  desc.line = session_.line;
  desc.zoom = session_.zoom;
  desc.centre = session_.centre;
  const scene::Bounds bounds = session_.scene ? session_.scene->bounds : scene::Bounds{};
  desc.farDepth = std::max(1e-6f, static_cast<float>(glm::length(bounds.max - bounds.min)) / 8);
  desc.lineWidth = std::max(1.0f, window_->scale());
  shown_ = screen_->draw(desc, *ImGui::GetDrawData());
  if (!device_->present(shown_)) settle_ = std::max(settle_, 1);
}

void Viewer::savePicture() {
  if (!stage_) return;
  session_.attempt([&] {
    StageDesc desc = stageDesc();
    if (!panel_.pictureAsShown) desc.size = panel_.pictureSize;
    const image::Image picture = stage_->picture(desc, desc.left);
    const std::string name = fileName(desc.left);
    for (const char* ending : {".png", ".exr"}) {
      image::write(picture, name + ending, {.transfer = frame::transferOf(desc.left)});
    }
    session_.say(fmt::format("{0}.png and {0}.exr, {1}x{2} px", name, desc.size.x, desc.size.y));
  });
  settle_ = std::max(settle_, 1);
}

void Viewer::saveScreenshot() {
  const glm::uvec2 pixels = window_->pixels();
  const image::Image window =
      frame::toImage(device_->read(shown_), gpu::Format::kRgba8Unorm, pixels.x, pixels.y);
  image::write(frame::firstChannels(window, 3), options_.screenshot);
}

void Viewer::writeLayout() {
  if (options_.layoutFile.empty()) return;
  const Place where = place();
  const auto corner = glm::vec2(where.corner), end = corner + glm::vec2(where.size);
  panel_.layout.note("picture", corner.x, corner.y, end.x, end.y,
                     stage_ && !stage_->isStale(stageDesc()) ? "done" : "stale");
  panel_.layout.note("camera", 0, 0, 0, 0, scene::cameraJson(session_.camera));
  panel_.layout.note("drawn", 0, 0, 0, 0, fmt::format("{}", drawn_));
  std::string text = panel_.layout.json();
  if (text == layoutWritten_) return;
  session_.attempt([&] { image::writeFileAside(options_.layoutFile, text); });
  layoutWritten_ = std::move(text);
}

}  // namespace grisaille::app::viewer
