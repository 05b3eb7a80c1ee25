// SPDX-License-Identifier: MIT
// The ambient visibility of one view after another, traced beside the caller's thread and refined
// until it is as good as wanted: first of a few pixels, then of all, then with more rays.
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
#include "core/trace/ray_tracer.h"

namespace grisaille::app::truth {

// What is traced.
struct LiveView {
  std::shared_ptr<const scene::Scene> scene;
  scene::Camera camera;             // its own size does not count
  glm::uvec2 size = glm::uvec2(0);  // pixels
  double radius = 0.5;              // metres
  uint32_t samples = 0;             // rays a pixel in the end, to kMostOcclusionRays

  bool operator==(const LiveView& other) const;
};

// What there is of it by now.
struct Traced {
  glm::uvec2 size = glm::uvec2(0);
  std::vector<trace::Visibility> values;  // by rows; kUntraced where none is known
  uint64_t pixels = 0;                    // that are known
  double rays = 0;                        // a known pixel, on average
  bool done = false;
};

class LiveTruth {
 public:
  LiveTruth();
  ~LiveTruth();  // waits for some thousand rays, or for the scene to be prepared for rays
  LiveTruth(const LiveTruth&) = delete;
  LiveTruth& operator=(const LiveTruth&) = delete;

  // Anew, whatever is being traced. Does not wait. Begins with what `grisaille truth` has kept of
  // this view; keeps nothing itself, since a view that is passed by is seldom seen again.
  void start(const LiveView& view);

  // Ends it and lets go of the scene. Does not wait.
  void cancel();

  bool running() const;

  // True where there is more than at the last call: it is in `traced`. Throws Error, once, where
  // the scene cannot be traced.
  bool poll(Traced& traced);

 private:
  struct Job;
  void work();
  void trace(const LiveView& view);
  bool addSlice(Job& job, size_t first, uint32_t from, uint32_t to);

  // Of the thread alone.
  std::shared_ptr<const scene::Scene> scene_;  // that the tracer is of
  std::unique_ptr<trace::RayTracer> tracer_;
  std::optional<uint64_t> sceneHash_;
  std::vector<uint32_t> order_;  // of the pixels of a picture of this size
  glm::uvec2 orderSize_ = glm::uvec2(0);

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<LiveView> next_;
  Traced traced_;
  std::exception_ptr failure_;
  bool running_ = false, fresh_ = false, forget_ = false, quit_ = false;
  std::atomic<bool> stop_ = false;  // written under the lock, read between slices
  std::thread thread_;              // last: all else is there when it starts
};

}  // namespace grisaille::app::truth
