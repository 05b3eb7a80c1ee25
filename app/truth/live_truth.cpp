// SPDX-License-Identifier: MIT
#include "app/truth/live_truth.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "app/truth/cache.h"
#include "app/truth/comparison.h"
#include "app/truth/content_hash.h"
#include "app/truth/occlusion_truth.h"
#include "app/truth/pixel_order.h"
#include "app/truth/refine.h"
#include "core/trace/background.h"

namespace grisaille::app::truth {
namespace {

// Niceness of the tracing thread, so that the window draws first. At 19, the lowest priority, a
// busy machine traces nothing for minutes.
constexpr int kNiceness = 10;

// Rays per pixel of the first pass: the fewest that give a good standard error.
constexpr uint32_t kFirstRays = 2 * trace::kScrambles;

// Pixels between two checks of stop_: about ten milliseconds of one core.
constexpr size_t kLiveSlice = 1024;

uint32_t passEnd(uint32_t from, uint32_t samples) {
  const uint32_t to = from == 0 ? kFirstRays : (from / kPassRays + 1) * kPassRays;
  return std::min(to, samples);
}

// Lets the threads of the window and the driver run first. On Linux, niceness is set per thread.
void giveWay() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
}

}  // namespace

bool LiveView::operator==(const LiveView& o) const {
  return scene == o.scene && pose == o.pose && camera == o.camera && size == o.size &&
         radius == o.radius && samples == o.samples;
}

struct LiveTruth::Job {
  const LiveView& view;
  std::vector<trace::OcclusionCounts> counts;  // in the order of order_
  std::vector<glm::uvec2> pixels;              // pixels of the current slice
};

LiveTruth::LiveTruth() : thread_([this] { work(); }) {}

LiveTruth::~LiveTruth() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void LiveTruth::start(const LiveView& view) {
  {
    const std::lock_guard lock(mutex_);
    next_ = view;
    if (copied_ != view.scene) {
      copied_ = view.scene;
      copy_ = view.scene->rig ? std::make_shared<scene::Scene>(*view.scene) : nullptr;
    }
    stop_ = true;
    traced_ = {};
    failure_ = nullptr;
    running_ = true;
    fresh_ = forget_ = false;
  }
  wake_.notify_one();
}

void LiveTruth::cancel() {
  {
    const std::lock_guard lock(mutex_);
    next_.reset();
    copied_.reset();
    copy_.reset();
    traced_ = {};
    failure_ = nullptr;
    running_ = fresh_ = false;
    stop_ = forget_ = true;
  }
  wake_.notify_one();
}

bool LiveTruth::running() const {
  const std::lock_guard lock(mutex_);
  return running_;
}

bool LiveTruth::poll(Traced& traced) {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (!std::exchange(fresh_, false)) return false;
  traced = traced_;
  return true;
}

void LiveTruth::work() {
  giveWay();
  trace::leavingACore([this] {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return quit_ || next_ || forget_; });
      if (quit_) return;
      if (std::exchange(forget_, false)) {
        tracer_.reset();
        scene_.reset();
        posed_.reset();
        continue;
      }
      const LiveView view = *std::exchange(next_, std::nullopt);
      const std::shared_ptr<scene::Scene> copy = copy_;
      stop_ = false;
      lock.unlock();
      std::exception_ptr failure;
      try {
        trace(view, copy);
      } catch (...) {
        failure = std::current_exception();
        scene_.reset();  // the next view begins anew
      }
      lock.lock();
      if (stop_) continue;
      failure_ = failure;
      running_ = false;
    }
  });
}

// Keeps the tracer from view to view, so that a move of the camera does not wait for a new one.
void LiveTruth::setUp(const LiveView& view, const std::shared_ptr<scene::Scene>& copy) {
  const bool fresh = scene_ != view.scene || !tracer_;
  if (fresh) {
    tracer_.reset();
    sceneHash_.reset();
    scene_ = view.scene;
    posed_ = copy;
  }
  if (posed_ && (fresh || !(pose_ == view.pose))) {
    sceneHash_.reset();
    scene::pose(*posed_, view.pose);
    pose_ = view.pose;
  }
  const scene::Scene& scene = posed_ ? *posed_ : *scene_;
  if (fresh) tracer_ = std::make_unique<trace::RayTracer>(scene, view.camera.eye);
  tracer_->follow();
  if (!stop_ && !sceneHash_) sceneHash_ = hashOf(scene);
}

void LiveTruth::trace(const LiveView& view, const std::shared_ptr<scene::Scene>& copy) {
  setUp(view, copy);
  if (stop_) return;
  scene::Camera sized = view.camera;
  sized.size = view.size;
  const size_t size = size_t{view.size.x} * view.size.y;
  const Cache cache(cacheFolder(), keyOf("ao", *sceneHash_, sized, view.radius, kSeed));
  const Counts kept = cache.load(size);
  if (std::exchange(orderSize_, view.size) != view.size) order_ = pixelOrder(view.size);
  Job job{.view = view, .counts = {}, .pixels = {}};
  job.counts.reserve(size);
  for (const uint32_t pixel : order_) job.counts.push_back(kept.pixels[pixel]);
  {
    const std::lock_guard lock(mutex_);
    if (stop_) return;
    traced_ = {.size = view.size, .values = std::vector<trace::Visibility>(size, {0, kUntraced})};
  }
  // If the cache has counts, the first pass only shows them.
  uint32_t from = kept.samples;
  uint32_t to = from > 0 ? from : passEnd(0, view.samples);
  for (;; from = to, to = passEnd(from, view.samples)) {
    for (size_t first = 0; first < size; first += kLiveSlice) {
      if (!addSlice(job, first, from, to)) return;
    }
    if (to >= view.samples) break;
  }
  const std::lock_guard lock(mutex_);
  if (!stop_) traced_.done = fresh_ = true;
}

// Traces one slice of a pass. Casts the primary rays again in every pass: one more ray for each
// kPassRays, instead of storing a hundred bytes per pixel. Returns false if the view was cancelled.
bool LiveTruth::addSlice(Job& job, size_t first, uint32_t from, uint32_t to) {
  if (stop_) return false;
  const LiveView& view = job.view;
  const std::span pixels = std::span(order_).subspan(first);
  const size_t count = std::min(kLiveSlice, pixels.size());
  job.pixels.clear();
  for (const uint32_t pixel : pixels.first(count)) {
    job.pixels.emplace_back(pixel % view.size.x, pixel / view.size.x);
  }
  const std::span counts = std::span(job.counts).subspan(first, count);
  const auto hits = tracer_->castPrimary(view.camera, view.size.x, view.size.y, job.pixels);
  tracer_->addOcclusion(hits, view.radius, kSeed, from, to, counts);
  const auto values = trace::visibilityOf(hits, counts);

  const std::lock_guard lock(mutex_);
  if (stop_) return false;
  // During the first pass, all known pixels have the same number of rays.
  const bool all = traced_.pixels == order_.size();
  const double share = static_cast<double>(first + count) / static_cast<double>(order_.size());
  traced_.rays = all ? from + share * (to - from) : to;
  if (!all) traced_.pixels += count;
  for (size_t i = 0; i < count; ++i) traced_.values[pixels[i]] = values[i];
  fresh_ = true;
  return true;
}

}  // namespace grisaille::app::truth
