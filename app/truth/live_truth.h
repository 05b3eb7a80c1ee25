// SPDX-License-Identifier: MIT
// Traces the ambient visibility of the current view on a thread of its own. It traces a few pixels
// first, then all pixels, then adds rays until each pixel has LiveView::samples.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/rig.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app::truth {

// The view to trace.
struct LiveView {
  std::shared_ptr<const scene::Scene> scene;
  scene::Pose pose = {};            // that the scene has
  scene::Camera camera;             // camera.size is ignored
  glm::uvec2 size = glm::uvec2(0);  // pixels
  double radius = 0.5;              // metres
  uint32_t samples = 0;             // final rays per pixel, at most kMostOcclusionRays

  bool operator==(const LiveView& other) const;
};

// The result so far.
struct Traced {
  glm::uvec2 size = glm::uvec2(0);
  std::vector<trace::Visibility> values;  // by rows; standard error kUntraced: not traced yet
  uint64_t pixels = 0;                    // number of traced pixels
  double rays = 0;                        // mean rays per traced pixel
  bool done = false;
};

class LiveTruth {
 public:
  LiveTruth();
  ~LiveTruth();  // waits for the current slice, or for Embree's scene to be built
  LiveTruth(const LiveTruth&) = delete;
  LiveTruth& operator=(const LiveTruth&) = delete;

  // Starts tracing `view` and drops the view before it. Does not wait. Starts from the counts that
  // `grisaille truth` cached for this view; does not write the cache, since a view that the camera
  // passes is seldom seen again. Copies a scene that has a rig, so that its owner may pose it while
  // this traces.
  void start(const LiveView& view);

  // Stops tracing and releases the scene. Does not wait.
  void cancel();

  bool running() const;

  // Returns whether the result has changed since the last call, and copies it to `traced` if so.
  // Rethrows, once, the error of a scene that cannot be traced.
  bool poll(Traced& traced);

 private:
  struct Job;
  void work();
  void trace(const LiveView& view, const std::shared_ptr<scene::Scene>& copy);
  void setUp(const LiveView& view, const std::shared_ptr<scene::Scene>& copy);
  bool addSlice(Job& job, size_t first, uint32_t from, uint32_t to);

  // Used by the tracing thread only.
  std::shared_ptr<const scene::Scene> scene_;  // the scene of tracer_, as its owner knows it
  std::shared_ptr<scene::Scene> posed_;        // its copy; null: it has no rig
  scene::Pose pose_;                           // of posed_
  std::unique_ptr<trace::RayTracer> tracer_;
  std::optional<uint64_t> sceneHash_;
  std::vector<uint32_t> order_;  // pixelOrder(orderSize_)
  glm::uvec2 orderSize_ = glm::uvec2(0);

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<LiveView> next_;
  std::shared_ptr<const scene::Scene> copied_;  // the scene of copy_, as its owner knows it
  std::shared_ptr<scene::Scene> copy_;          // only the tracing thread uses its content
  Traced traced_;
  std::exception_ptr failure_;
  bool running_ = false, fresh_ = false, forget_ = false, quit_ = false;
  std::atomic<bool> stop_ = false;  // written under the lock, read between slices
  std::thread thread_;              // last member: it uses all others from its start
};

}  // namespace grisaille::app::truth
