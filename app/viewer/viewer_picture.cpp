// SPDX-License-Identifier: MIT
// The viewer's picture: composes it in the window, and writes pictures and the layout to files.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <imgui/imgui.h>

#include "app/truth/error_map.h"
#include "app/viewer/viewer.h"
#include "core/base/atomic_file.h"
#include "core/frame/texture_image.h"

namespace grisaille::app::viewer {
namespace {

// Seconds until a frame that failed is tried again; each failure doubles them.
constexpr double kLeastRetry = 0.5, kMostRetry = 16;

constexpr const char* kPictureEndings[] = {".png", ".exr"};

// A file name without ending. Adds a number if it is taken, since the user may save two pictures in
// one second.
std::string fileName(std::string output) {
  std::ranges::replace(output, '.', '-');
  const std::string first = fmt::format("grisaille-{}-{}", timeStamp(), output);
  std::string name = first;
  const auto isThere = [&](const char* ending) { return std::filesystem::exists(name + ending); };
  for (int number = 2; std::ranges::any_of(kPictureEndings, isThere); ++number) {
    name = fmt::format("{}-{}", first, number);
  }
  return name;
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

// What both sides of the picture share.
StageDesc Viewer::commonDesc() {
  StageDesc desc;
  desc.camera = session_.camera;
  desc.size = place().size;
  desc.surface = session_.surface;
  desc.background = session_.background;
  desc.chain = &session_.chain;
  // Numbers against the truth are those of the whole picture.
  desc.halves = inMotion_ && session_.fineness.halves && wholeSeconds_ > Fineness::kSlowFrame &&
                session_.comparedOutput().empty();
  desc.averages = !inMotion_;
  desc.converges = session_.fineness.converges;
  return desc;
}

// Seconds a frame for work that can wait. While the camera moves or a button is held, frames come
// first: single steps of work may take longer than this. Else, if a frame takes long anyway,
// this work may take as long: the picture is complete sooner.
double Viewer::placingPatience() const {
  return moving_ ? 0.002 : std::clamp(updateSeconds_, 0.03, 0.3);
}

StageDesc Viewer::stageDesc() {
  StageDesc desc = commonDesc();
  desc.liveRevision = session_.revision;
  desc.poses = session_.scene ? session_.scene->poses : 0;
  // The compared output stands in for truth and error until these have a texture.
  const std::string compared = session_.comparedOutput();
  desc.left = isTruthView(session_.left) ? compared : session_.left;
  if (session_.split && !otherDesc()) {
    desc.right = isTruthView(session_.right) ? compared : session_.right;
    if (session_.held && !isTruthView(session_.right)) {
      desc.held = &*session_.held;
      desc.heldRevision = session_.heldRevision;
    }
  }
  desc.patience = placingPatience();
  if (!compared.empty()) desc.extra.push_back(compared);
  return desc;
}

bool Viewer::isStale() {
  return stage_ && (stage_->isStale(stageDesc()) || isOtherStale());
}

void Viewer::updateStage() {
  if (!stage_) return;
  compareWithTruth();
  const StageDesc desc = stageDesc();
  if (session_.paused && !session_.step) return;
  session_.step = false;
  if (desc.size.x == 0 || desc.size.y == 0) return;
  if (session_.continuous) stage_->touch();
  if (!isStale()) {
    if (panel_.wantsCoverage) session_.attempt("coverage", [&] { updateCoverage(); });
    return;
  }
  const auto draw = [&] {
    const Clock::time_point start = Clock::now();
    stage_->update(desc);
    updateOther();
    updateSeconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    wholeFrames_ = desc.halves ? 0 : wholeFrames_ + 1;
    if (!desc.halves) wholeSeconds_ = updateSeconds_;
    if (panel_.wantsCoverage) updateCoverage();
    const std::string compared = session_.comparedOutput();
    if (compared.empty()) return;
    truth_->show({.scene = session_.scene,
                  .pose = session_.playback.pose,
                  .camera = desc.camera,
                  .size = desc.size,
                  .radius = session_.truthRadius(),
                  .samples = session_.comparing.rays},
                 stage_->read(compared));
  };
  if (options_.frames > 0) {
    draw();  // a run of so many frames ends by the error of one
  } else if (session_.attempt("frame", draw)) {
    retry_ = {};
  } else {
    retry_.wait = std::clamp(2 * retry_.wait, kLeastRetry, kMostRetry);
    retry_.at = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(retry_.wait));
  }
  settle_ = std::max(settle_, 1);  // the panel shows the new values
}

// Follows changes of the truth's settings while the picture stays the same.
void Viewer::compareWithTruth() {
  if (session_.comparedOutput().empty()) {
    truth_->stop();
  } else {
    truth_->follow(session_.truthRadius(), session_.comparing.rays);
  }
}

TruthStatus Viewer::truthStatus() {
  TruthStatus status;
  status.running = truth_->running();
  status.comparison = truth_->comparison();
  status.rays = truth_->rays();
  status.share = truth_->share();
  if (const auto texel = controls_.texel(place())) status.cursor = truth_->at(glm::uvec2(*texel));
  return status;
}

Side Viewer::side(bool right) {
  if (!stage_ || !stage_->texture(false)) return {};
  const std::string& view = right ? session_.right : session_.left;
  if (isTruthView(view)) {
    if (const auto side = truth_->side(view)) return *side;
  }
  if (right && other_ && otherDesc()) {
    if (const auto side = other_->side()) return *side;
  }
  return {stage_->texture(right), stage_->kind(right)};
}

// True if the sides that are shown in turn change now.
bool Viewer::turnSides() {
  if (!session_.split || session_.splitting.way != SplitWay::kFlicker) {
    turned_ = false;
    return false;
  }
  const Clock::time_point now = Clock::now();
  if (now < turnAt_) return false;
  turned_ = !turned_;
  turnAt_ = now + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(session_.splitting.turn));
  return true;
}

// Sides of different kinds have no common unit, and the truth has numbers of its own.
void Viewer::compareSides() {
  const bool traced = isTruthView(session_.left) || isTruthView(session_.right);
  if (!session_.split || traced || !stage_) return apart_.reset();
  const std::array<Side, 2> sides = {side(false), side(true)};
  if (!sides[0].texture || !sides[1].texture || sides[0].kind != sides[1].kind) {
    return apart_.reset();
  }
  const uint64_t revision = stage_->revision() + (other_ ? other_->revision() : 0);
  if (apart_ && apart_->sides == sides && apart_->revision == revision) return;
  apart_.reset();
  apart_ = {sides, revision, difference_->compare(sides, stage_->texels())};
  settle_ = std::max(settle_, 1);  // the panel shows the new numbers
}

std::array<std::string, 2> Viewer::sideNames() {
  std::array<std::string, 2> names;
  for (const bool right : {false, true}) {
    const std::string& view = right ? session_.right : session_.left;
    std::string& name = names[right ? 1 : 0] = view;
    for (const Viewable& one : session_.views(right)) {
      if (one.output == view) name = one.label;
    }
    if (session_.held && !isTruthView(view)) name += right ? ", held settings" : ", live settings";
    if (!otherDesc()) continue;
    name += std::string(", ") + backends::find(right ? session_.splitting.backend : backend_).label;
  }
  return names;
}

std::vector<float> Viewer::cursorValue(bool right, glm::uvec2 texel) {
  const std::string& view = right ? session_.right : session_.left;
  if (right && other_ && otherDesc()) return other_->valueAt(texel);
  if (!isTruthView(view)) return stage_->valueAt(right, texel);
  const auto point = truth_->at(texel);
  if (!point) return {};
  return {view == kTruthView ? point->truth : point->shown - point->truth};
}

// Measures again once what it measures has changed and all objects are placed.
void Viewer::updateCoverage() {
  const auto owned = findOwned(session_.chain.selection.effects());
  if (!owned || stage_->waiting() > 0 || !session_.services->rays().isReady()) return;
  const Measured now = {owned->effect, session_.revision, session_.chain.objectsRevision(),
                        session_.scene->poses, session_.scene.get()};
  if (std::exchange(measured_, now) == now) return;
  constexpr uint32_t kPoints = 20'000;  // a standard error of 0.0035 at most
  coverage_ =
      coverageOf(session_.chain, *owned, session_.services->rays(), {.points = kPoints}).shares;
  settle_ = std::max(settle_, 1);  // the panel shows the new numbers
}

Status Viewer::status() {
  for (const gpu::FrameTimes& frame : device_->takeTimes()) {
    const bool own = std::ranges::all_of(
        frame.passes, [](const gpu::PassTime& pass) { return pass.label.starts_with("viewer/"); });
    if (own) continue;
    times_.add(frame);
    // A device works a few frames behind; a software driver's update has waited for it.
    constexpr uint32_t kBehind = 4;
    if (wholeFrames_ > kBehind) {
      wholeSeconds_ = std::max(updateSeconds_, frame.wholeMilliseconds / 1000);
    }
  }
  Status status;
  status.device = device_->info();
  status.passes = times_.all();
  status.sum = times_.sum();
  status.whole = times_.whole();
  status.coverage = coverage_;
  status.picture = place().size;
  status.halved = stage_ && stage_->scale() > 1;
  status.averaged = stage_ ? stage_->frames() : 0;
  status.toAverage = framesAveraged(session_.chain.selection, session_.fineness.converges);
  status.givenUp = stage_ ? stage_->givenUp() : 0;
  status.coarser = stage_ ? stage_->coarser() : 0;
  if (stage_) status.leftOut = stage_->leftOut();
  status.waiting = (stage_ ? stage_->waiting() : 0) + (other_ ? other_->waiting() : 0);
  status.backend = backend_;
  if (session_.split) status.sides = sideNames();
  if (apart_) status.apart = apart_->numbers;
  status.turned = turned_;
  if (loading_.running()) {
    status.loading = loading_.progress();
    status.loadingPath = sceneLabel(loading_.path());
  }
  status.failedScene = failedScene_;
  status.truth = truthStatus();
  status.tune = tuning_;
  const ChildRun::State sequence = sequence_.state();
  status.sequence = {sequence_.started(), sequence.done, sequence.text};
  status.rebuilding = rebuild_.building();
  status.buildMessage = buildMessage_;
  const auto texel = controls_.texel(place());
  if (session_.inspecting && stage_ && texel) {
    session_.attempt("value", [&] {
      status.cursorTexel = *texel;
      status.cursorRight = controls_.rightSide(place());
      for (const bool right : {false, true}) {
        if (right && !session_.split) continue;
        status.cursorValues[right ? 1 : 0] = cursorValue(right, glm::uvec2(*texel));
      }
    });
  }
  return status;
}

void Viewer::drawWindow() {
  ScreenDesc desc;
  desc.pixels = window_->pixels();
  if (desc.pixels.x == 0 || desc.pixels.y == 0) return;
  desc.place = place();
  desc.keeps = retry_.wait > 0;
  session_.attempt("sides", [&] {
    compareSides();
    desc.sides = {side(false), side(session_.split)};
  });
  if (stage_) {
    desc.size = stage_->size();
    desc.scale = stage_->scale();
    desc.revision = stage_->revision() + truth_->revision();  // for one scene, all only grow
    if (other_) desc.revision += other_->revision();
  }
  desc.split = session_.split;
  desc.line = session_.line;
  desc.way = session_.splitting.way;
  desc.turned = turned_;
  desc.full = session_.splitting.full;
  desc.zoom = session_.zoom;
  desc.centre = session_.centre;
  desc.farDepth = std::max(1e-6f, static_cast<float>(session_.extent) / 8);
  desc.pictures = &panel_.thumbnails.pictures();
  desc.lineWidth = std::max(1.0f, window_->scale());
  shown_ = screen_->draw(desc, *ImGui::GetDrawData());
  if (!device_->present(shown_)) settle_ = std::max(settle_, 1);
}

image::Image Viewer::pictureOf(const std::string& view) {
  if (isTruthView(view)) {
    if (!panel_.pictureAsShown) {
      throw Error(ErrorId::kUsage, "the truth can be saved only at the size on the screen");
    }
    if (truth_->share() == 0) throw Error(ErrorId::kUsage, "nothing is traced yet");
    return truth_->numbers(view);
  }
  StageDesc desc = stageDesc();
  desc.halves = false;
  if (!panel_.pictureAsShown) desc.size = panel_.pictureSize;
  return stage_->picture(desc, desc.left);
}

void Viewer::savePicture() {
  if (!stage_) return;
  session_.attempt("picture", [&] {
    const std::string name = fileName(session_.left);
    const image::Image picture = pictureOf(session_.left);
    for (const std::string ending : kPictureEndings) {
      const bool colors = session_.left == kErrorView && ending == ".png";
      image::write(colors ? truth::errorMap(picture) : picture, name + ending,
                   {.transfer = frame::transferOf(session_.left)});
    }
    session_.say(
        fmt::format("{0}.png and {0}.exr, {1}x{2} px", name, picture.width, picture.height));
  });
  settle_ = std::max(settle_, 1);
}

void Viewer::saveCapture() {
  const glm::uvec2 pixels = window_->pixels();
  const image::Image window =
      frame::toImage(device_->read(shown_), gpu::Format::kRgba8Unorm, pixels.x, pixels.y);
  image::write(frame::firstChannels(window, 3), options_.capture);
}

void Viewer::writeLayout() {
  if (options_.layoutFile.empty()) return;
  const Place where = place();
  const auto corner = glm::vec2(where.corner), end = corner + glm::vec2(where.size);
  const bool done = settle_ == 0 && !inMotion_ && stage_ && !isStale();
  panel_.layout.note("picture", corner.x, corner.y, end.x, end.y,
                     retry_.wait > 0                    ? "failed"
                     : !stage_ && !failedScene_.empty() ? "empty"
                     : done                             ? "done"
                                                        : "stale");
  panel_.layout.note("camera", 0, 0, 0, 0, scene::cameraJson(session_.camera));
  panel_.layout.note("scale", 0, 0, 0, 0, fmt::format("{}", stage_ ? stage_->scale() : 1));
  panel_.layout.note("drawn", 0, 0, 0, 0, fmt::format("{}", drawn_));
  panel_.layout.note("typing", 0, 0, 0, 0, ImGui::GetIO().WantTextInput ? "true" : "false");
  if (session_.comparing.on) {
    panel_.layout.note("truths", 0, 0, 0, 0, fmt::format("{}", truth_->started()));
    panel_.layout.note("rmse", 0, 0, 0, 0, fmt::format("{:.7f}", truth_->comparison().rmse));
    panel_.layout.note("truth", 0, 0, 0, 0,
                       truth_->running()      ? "traced"
                       : truth_->share() == 1 ? "done"
                                              : "none");
  }
  std::string text = panel_.layout.json();
  if (text == layoutWritten_) return;
  session_.attempt("layout", [&] { writeFileAtomically(options_.layoutFile, text); });
  layoutWritten_ = std::move(text);
}

}  // namespace grisaille::app::viewer
