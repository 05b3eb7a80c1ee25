// SPDX-License-Identifier: MIT
#include "lab/claims/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/services/scene_services.h"
#include "app/study/flicker_run.h"
#include "app/study/measurer.h"
#include "app/study/record.h"
#include "core/base/error.h"
#include "core/scene/rig.h"
#include "core/trace/projection.h"
#include "lab/claims/floor.h"
#include "lab/claims/metrics.h"
#include "lab/claims/picture.h"
#include "lab/claims/regions.h"
#include "lab/claims/screen_splats.h"
#include "lab/paint/paint_mask.h"

namespace grisaille::lab::claims {

// The ray-traced frames along one path of cameras and times. Frames that no metric reads are empty.
struct ClaimsRunner::View {
  std::vector<scene::Camera> cameras;
  std::vector<double> seconds;
  std::vector<trace::FlickerFrame> frames;
  std::vector<image::Image> truth;  // one per frame
  std::map<std::string, std::vector<std::vector<uint8_t>>> regions;
};

struct ClaimsRunner::Run {
  const ClaimRun* desc = nullptr;
  effect::Chain chain;
  View* view = nullptr;
  std::vector<image::Image> shown;  // the measured output, one per frame, one channel
  image::Image color;               // the composed picture of the last frame
  std::vector<double> milliseconds;
};

// Measures one claim on one device.
class ClaimsRunner::Stage {
 public:
  Stage(const ClaimsDesc& desc, const Claim& claim, gpu::Device& device, scene::Scene& scene)
      : desc_(desc),
        claim_(claim),
        device_(device),
        scene_(scene),
        services_(scene),
        renderer_(device, scene) {}

  void start();
  void showAll();
  void timeAll();
  ClaimResult judge();

 private:
  View& viewOf(const ClaimRun& run);
  void poseAt(const std::vector<double>& seconds, size_t frame);
  std::vector<uint8_t> movedLast() const;
  bool reads(Over over) const;
  trace::FlickerFrame frameOf(const scene::Camera& camera) const;
  bool timed() const;
  void render(Run& run, const scene::Camera& camera, const std::vector<std::string>& outputs);
  image::Image shownBy(Run& run, const scene::Camera& camera);
  ScreenSplats splatsOf(Run& run) const;
  const std::vector<image::Image>& referenceOf(const Run& run);
  const std::vector<std::vector<uint8_t>>& regionOn(View& view, const std::string& names) const;
  double valueOf(Run& run, const Term& term);
  std::vector<PictureRow> pictures();

  const ClaimsDesc& desc_;
  const Claim& claim_;
  gpu::Device& device_;
  scene::Scene& scene_;
  std::vector<uint8_t> moved_;  // instances that move up to the last frame
  app::SceneServices services_;
  frame::Renderer renderer_;
  std::vector<std::unique_ptr<View>> views_;
  std::vector<Run> runs_;
};

bool ClaimResult::holds() const {
  return std::ranges::all_of(expectations, &ExpectationResult::holds);
}

// Traces a frame with its truth: ambient visibility, or the mask of paint.
trace::FlickerFrame ClaimsRunner::Stage::frameOf(const scene::Camera& camera) const {
  if (claim_.shots.empty()) {
    return app::study::traceFrame(scene_, camera, claim_.size, claim_.radius, desc_.samples,
                                  desc_.progress);
  }
  const trace::RayTracer tracer(scene_, camera.eye);
  trace::FlickerFrame frame{.camera = camera, .hits = {}, .ao = {}, .truth = {}};
  frame.hits = tracer.castPrimary(camera, claim_.size.x, claim_.size.y);
  effect::Selection selection = selectionOf(*desc_.registry, claim_, nullptr);
  const std::vector<uint8_t> mask =
      paintMask(tracer, frame.hits, claim_.shots, selection.values("sspm").get("paint_range"));
  frame.truth = {.width = claim_.size.x,
                 .height = claim_.size.y,
                 .channels = 1,
                 .pixels = std::vector<float>(mask.begin(), mask.end())};
  return frame;
}

void ClaimsRunner::Stage::poseAt(const std::vector<double>& seconds, size_t frame) {
  if (seconds.empty()) return;
  scene::pose(scene_, {.animation = claim_.animation, .seconds = seconds[frame]});
}

// Instances that move from the last frame but one to the last.
std::vector<uint8_t> ClaimsRunner::Stage::movedLast() const {
  if (claim_.seconds.empty()) return {};
  const size_t last = claim_.seconds.size() - 1;
  scene::Scene then = scene_, now = scene_;
  scene::pose(then, {.animation = claim_.animation, .seconds = claim_.seconds[last - 1]});
  scene::pose(now, {.animation = claim_.animation, .seconds = claim_.seconds[last]});
  std::vector<uint8_t> moved;
  for (size_t i = 0; i < now.instances.size(); ++i) {
    const scene::Primitive& primitive = now.primitives[now.instances[i].primitive];
    bool moves = then.instances[i].worldFromObject != now.instances[i].worldFromObject;
    for (uint32_t k = 0; k < primitive.indexCount && !moves; ++k) {
      const uint32_t vertex = now.indices[primitive.firstIndex + k];
      moves = then.positions[vertex] != now.positions[vertex];
    }
    moved.push_back(moves ? 1 : 0);
  }
  return moved;
}

// Whether an expectation or a picture reads these frames.
bool ClaimsRunner::Stage::reads(Over over) const {
  if (over == Over::kLast) return true;  // the pictures
  if (over == Over::kAll && claim_.picture.show == PictureKind::kChange) return true;
  const auto needs = [&](const Term& term) { return findMetric(term.metric)->over == over; };
  return std::ranges::any_of(claim_.expectations, [&](const Expectation& e) {
    return needs(e.left) || (e.right && needs(*e.right));
  });
}

ClaimsRunner::View& ClaimsRunner::Stage::viewOf(const ClaimRun& run) {
  const auto same = [&](const scene::Camera& a, const scene::Camera& b) {
    return scene::cameraJson(a) == scene::cameraJson(b);
  };
  for (const auto& view : views_) {
    if (view->seconds == run.seconds && std::ranges::equal(view->cameras, run.cameras, same)) {
      return *view;
    }
  }
  auto view = std::make_unique<View>();
  view->cameras = run.cameras;
  view->seconds = run.seconds;
  for (size_t i = 0; i < run.cameras.size(); ++i) {
    const bool last = i + 1 == run.cameras.size();
    const bool traced = reads(Over::kAll) || last || (i == 0 && reads(Over::kFirst));
    poseAt(run.seconds, i);
    view->frames.push_back(traced ? frameOf(run.cameras[i]) : trace::FlickerFrame());
    view->truth.push_back(view->frames.back().truth);
  }
  views_.push_back(std::move(view));
  return *views_.back();
}

void ClaimsRunner::Stage::start() {
  // Another claim may have left the scene in a pose.
  if (scene_.rig && claim_.seconds.empty()) scene::pose(scene_, {});
  moved_ = movedLast();
  for (const ClaimRun& desc : claim_.runs) {
    Run run;
    run.desc = &desc;
    run.chain = effect::Chain(selectionOf(*desc_.registry, claim_, &desc));
    run.chain.start(device_);
    if (objects::ObjectList* list = run.chain.objects("sspm"); list != nullptr) {
      std::vector<Shot> shots;
      for (uint32_t i = 0; i < desc.shots; ++i) {
        Shot& shot = shots.emplace_back(claim_.shots[i % claim_.shots.size()]);
        // Shots of one ray are drawn as one. Each turn fires from a millimetre farther back.
        const auto turn = static_cast<double>(i / claim_.shots.size());
        for (size_t axis = 0; axis < 3; ++axis) {
          shot.origin[axis] -= 1e-3 * turn * double{shot.direction[axis]};
        }
      }
      list->assign(objectsOf(list->table(), shots).view());
    }
    run.view = &viewOf(desc);
    runs_.push_back(std::move(run));
  }
}

void ClaimsRunner::Stage::render(Run& run, const scene::Camera& camera,
                                 const std::vector<std::string>& outputs) {
  renderer_.render({.camera = camera,
                    .width = claim_.size.x,
                    .height = claim_.size.y,
                    .chain = &run.chain,
                    .outputs = outputs,
                    .services = services_.all()});
}

// The effect's own splats, with a cell size in pixels: the size of the effect's cells on the
// screen, at the middle of the first frame.
ScreenSplats ClaimsRunner::Stage::splatsOf(Run& run) const {
  const effect::Values& values = run.chain.selection.values("sspm");
  const trace::FlickerFrame& first = run.view->frames[0];
  const trace::Projection projection(first.camera, claim_.size.x, claim_.size.y);
  const size_t middle = size_t{claim_.size.y / 2} * claim_.size.x + claim_.size.x / 2;
  const double depth = first.hits[middle].viewDepth;
  if (depth == 0) {
    throw Error(ErrorId::kSettingsInvalid,
                "{}: noise = \"screen\" needs a surface in the middle of the picture",
                claim_.place);
  }
  return {.cell = values.get("splat_scale") * projection.scaleAt(depth),
          .sharpness = values.get("splat_sharpness"),
          .seed = static_cast<uint32_t>(values.get("noise_seed"))};
}

image::Image ClaimsRunner::Stage::shownBy(Run& run, const scene::Camera& camera) {
  if (run.desc->screenNoise) {
    render(run, camera, {"sspm.paint_coverage", "color"});
    return screenSplats(renderer_.read("sspm.paint_coverage"), splatsOf(run));
  }
  render(run, camera, {claim_.output, "color"});
  return app::study::oneChannel(renderer_.read(claim_.output), claim_.output);
}

void ClaimsRunner::Stage::showAll() {
  for (Run& run : runs_) {
    for (size_t i = 0; i < run.view->cameras.size(); ++i) {
      poseAt(run.view->seconds, i);
      run.shown.push_back(shownBy(run, run.view->cameras[i]));
      run.color = renderer_.read("color");
    }
  }
}

bool ClaimsRunner::Stage::timed() const {
  return std::ranges::any_of(claim_.expectations, [](const Expectation& e) {
    return findMetric(e.left.metric)->timed || (e.right && findMetric(e.right->metric)->timed);
  });
}

void ClaimsRunner::Stage::timeAll() {
  if (!timed()) return;
  for (uint32_t round = 0; round < desc_.rounds; ++round) {
    for (Run& run : runs_) {
      const std::vector<std::string> outputs = {claim_.output};
      render(run, run.view->cameras[0], outputs);  // creates resources before the measurement
      device_.wait();
      device_.takeTimes();
      render(run, run.view->cameras[0], outputs);
      device_.wait();
      const double share = frame::guardShare(run.chain.selection, claim_.size.x, claim_.size.y);
      run.milliseconds.push_back(app::study::costOf(device_.takeTimes(), claim_.effects, share));
    }
  }
}

const std::vector<image::Image>& ClaimsRunner::Stage::referenceOf(const Run& run) {
  if (run.desc->against.empty()) return run.view->truth;
  for (const Run& other : runs_) {
    if (other.desc->name != run.desc->against) continue;
    if (other.view == run.view) return other.shown;
    throw Error(ErrorId::kSettingsInvalid, "{}: '{}' is against a run with another camera",
                claim_.place, run.desc->name);
  }
  return run.view->truth;
}

const std::vector<std::vector<uint8_t>>& ClaimsRunner::Stage::regionOn(
    View& view, const std::string& names) const {
  auto [found, fresh] = view.regions.try_emplace(names);
  for (size_t i = 0; fresh && i < view.frames.size(); ++i) {
    trace::FlickerFrame& frame = view.frames[i];
    if (frame.hits.empty()) {
      found->second.emplace_back();
      continue;
    }
    frame.truth = view.truth[i];  // metrics overwrite it
    found->second.push_back(regionOf(
        names, frame, {.radius = claim_.radius, .distance = claim_.distance, .moved = moved_}));
  }
  return found->second;
}

double ClaimsRunner::Stage::valueOf(Run& run, const Term& term) {
  if (findMetric(term.metric)->timed) return app::study::medianOf(run.milliseconds);
  const Evidence evidence{.frames = run.view->frames,
                          .shown = run.shown,
                          .reference = referenceOf(run),
                          .region = regionOn(*run.view, term.region)};
  return measured(term.metric, evidence);
}

ClaimResult ClaimsRunner::Stage::judge() {
  ClaimResult result;
  const auto need = [&](const Term& term) {
    for (Run& run : runs_) {
      auto [value, fresh] = result.values[run.desc->name].try_emplace(term.quantity());
      if (fresh) value->second = valueOf(run, term);
    }
    const double value = result.values[term.run][term.quantity()];
    if (!std::isnan(value)) return;
    throw Error(ErrorId::kSettingsInvalid, "{}: the region of {}.{} has no pixels", claim_.place,
                term.run, term.quantity());
  };
  const auto value = [&](const Term& term) { return result.values[term.run][term.quantity()]; };
  for (const Expectation& expectation : claim_.expectations) {
    need(expectation.left);
    if (expectation.right) need(*expectation.right);
    const bool timed = findMetric(expectation.left.metric)->timed;
    result.expectations.push_back(
        {.left = value(expectation.left),
         .right = expectation.right ? value(*expectation.right) : expectation.factor,
         .holds = claims::holds(expectation, value),
         .timed = timed || (expectation.right && findMetric(expectation.right->metric)->timed)});
  }
  result.pictures = pictures();
  return result;
}

std::vector<PictureRow> ClaimsRunner::Stage::pictures() {
  const PictureDesc& desc = claim_.picture;
  std::vector<PictureRow> rows;
  std::map<std::string, size_t> rowOf;  // by the last frame's camera and time
  for (const auto& view : views_) {
    const std::string last = fmt::format("{} {}", scene::cameraJson(view->cameras.back()),
                                         view->seconds.empty() ? 0.0 : view->seconds.back());
    const bool fresh = desc.show == PictureKind::kChange || !rowOf.contains(last);
    if (fresh) {
      rowOf[last] = rows.size();
      rows.emplace_back();
    }
    PictureRow& row = rows[rowOf[last]];
    if (fresh && desc.show != PictureKind::kChange) {
      // The last frame, whose history holds the earlier frames.
      row.push_back({"truth", pictureOf(view->truth.back(), desc)});
    }
    for (Run& run : runs_) {
      if (run.view != view.get()) continue;
      if (desc.show == PictureKind::kChange) {
        std::vector<trace::FlickerFrame>& frames = view->frames;
        for (size_t i = 0; i < 2; ++i) {
          frames[i].ao = run.shown[i];
          frames[i].truth = referenceOf(run)[i];
          // Paint is fixed in the world: every change is an error.
          if (!claim_.shots.empty()) std::ranges::fill(frames[i].truth.pixels, 0.0f);
        }
        row.push_back({run.desc->name, changePicture(frames[0], frames[1], desc)});
      } else {
        const bool color = desc.show == PictureKind::kColor;
        row.push_back({run.desc->name, pictureOf(color ? run.color : run.shown.back(), desc)});
      }
    }
  }
  return rows;
}

ClaimsRunner::ClaimsRunner(const ClaimsDesc& desc, gpu::Device& device)
    : desc_(desc), device_(device) {}

ClaimsRunner::~ClaimsRunner() = default;

scene::Scene& ClaimsRunner::sceneOf(const Claim& claim) {
  const auto [found, isNew] = scenes_.try_emplace(std::pair(claim.scene, claim.floor));
  if (isNew) {
    found->second = scene::loadScene(claim.scene);
    if (claim.floor) addFloor(found->second);
  }
  return found->second;
}

ClaimResult ClaimsRunner::run(const Claim& claim) {
  Stage stage(desc_, claim, device_, sceneOf(claim));
  stage.start();
  stage.showAll();
  stage.timeAll();
  return stage.judge();
}

}  // namespace grisaille::lab::claims
