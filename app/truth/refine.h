// SPDX-License-Identifier: MIT
// An estimate of ambient visibility, refined pass by pass until it is good enough.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/truth/cache.h"
#include "app/truth/progress.h"
#include "core/trace/ray_tracer.h"

namespace grisaille::app::truth {

// Rays a pixel of one pass at most.
constexpr uint32_t kPassRays = 64;

// Casts the rays `from` ... `to` - 1 of these pixels, as RayTracer::addOcclusion() does.
using AddRays = std::function<void(std::span<const trace::Hit> hits, uint32_t from, uint32_t to,
                                   std::span<trace::OcclusionCounts> counts)>;

struct Goal {
  uint32_t samples = 0;  // rays a pixel at most, to kMostOcclusionRays
  double error = 0;      // an rms standard error that ends it earlier
};

struct Estimate {
  std::vector<trace::Visibility> values;
  uint32_t samples = 0;  // rays a pixel; more than asked for where more were kept
  uint32_t kept = 0;     // of these, from the cache
  double error = 0;      // rms standard error of the picture
  double seconds = 0;
  double rays = 0;  // cast in this run
};

// Begins with what the cache keeps, and keeps what is done there every few seconds and at the end.
// Where a signal asks for an end, the pass is finished and kept, and Interrupted is thrown after a
// note. `name` is for the note and how far it is.
Estimate refine(const std::string& name, std::span<const trace::Hit> hits, const AddRays& addRays,
                const Goal& goal, Cache& cache, ProgressStyle progress);

// One line: samples a pixel, rms standard error, seconds, rays a second.
std::string summaryOf(const std::string& name, const Estimate& estimate);

}  // namespace grisaille::app::truth
