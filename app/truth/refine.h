// SPDX-License-Identifier: MIT
// Refines an estimate of ambient visibility pass by pass until it reaches a goal.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/truth/cache.h"
#include "app/truth/progress.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app::truth {

// Largest number of rays per pixel in one pass.
constexpr uint32_t kPassRays = 64;

// Casts the rays `from` ... `to` - 1 of these pixels; see RayTracer::addOcclusion().
using AddRays = std::function<void(std::span<const trace::Hit> hits, uint32_t from, uint32_t to,
                                   std::span<trace::OcclusionCounts> counts)>;

struct Goal {
  uint32_t samples = 0;  // largest number of rays per pixel, at most kMostOcclusionRays
  double error = 0;      // rms standard error at which it stops early; 0: never
};

struct Estimate {
  std::vector<trace::Visibility> values;
  uint32_t samples = 0;  // rays per pixel; above Goal::samples if the cache held more
  uint32_t kept = 0;     // rays per pixel that came from the cache
  double error = 0;      // rms standard error of the picture
  double seconds = 0;
  double rays = 0;  // rays cast in this run
};

// Starts from the cached counts; saves to the cache every few seconds and at the end. After SIGINT
// or SIGTERM, finishes the pass, saves it, prints a note and throws Interrupted. `name`: for the
// note and the progress bar.
Estimate refine(const std::string& name, std::span<const trace::Hit> hits, const AddRays& addRays,
                const Goal& goal, Cache& cache, ProgressStyle progress);

// One line: samples per pixel, rms standard error, seconds, rays per second.
std::string summaryOf(const std::string& name, const Estimate& estimate);

}  // namespace grisaille::app::truth
