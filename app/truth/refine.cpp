// SPDX-License-Identifier: MIT
#include "app/truth/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/truth/interruption.h"
#include "app/truth/progress.h"
#include "core/base/error.h"

namespace grisaille::app::truth {
namespace {

using Clock = std::chrono::steady_clock;

// Pixels between two progress reports.
constexpr size_t kRefineSlice = 8192;
constexpr double kSaveSeconds = 5;
// Saving takes no more than this share of the time.
constexpr double kSaveShare = 0.05;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Saves the counts often enough to lose little work, and seldom enough to cost little time.
class Saver {
 public:
  explicit Saver(Cache& cache) : cache_(cache) {}

  void saveIfDue(const Counts& counts) {
    if (secondsSince(last_) >= std::max(kSaveSeconds, cost_ / kSaveShare)) save(counts);
  }
  void save(const Counts& counts) {
    if (counts.samples == saved_) return;
    const Clock::time_point start = Clock::now();
    cache_.save(counts);
    cost_ = secondsSince(start);
    saved_ = counts.samples;
    last_ = Clock::now();
  }
  void isSaved(uint32_t samples) { saved_ = samples; }

 private:
  Cache& cache_;
  Clock::time_point last_ = Clock::now();
  double cost_ = 0;
  uint32_t saved_ = 0;
};

// An estimate of the samples per pixel that reach the goal. The error of scrambled points falls
// about as n^-0.75 where visibility is discontinuous.
double expectedSamples(const Goal& goal, uint32_t samples, double error) {
  if (goal.error <= 0 || samples == 0 || error <= goal.error) return goal.samples;
  return std::min<double>(goal.samples, samples * std::pow(error / goal.error, 1 / 0.75));
}

std::string progressText(const Goal& goal, double samples, double error) {
  const std::string text = fmt::format("{:.0f} of {} samples per pixel", samples, goal.samples);
  return error > 0 ? text + fmt::format(", error {:.4f}", error) : text;
}

// Casts the rays of all pixels up to number `to`. Calls report(samples per pixel so far) after each
// slice.
template <typename Report>
void castPass(std::span<const trace::Hit> hits, const AddRays& addRays, Counts& counts, uint32_t to,
              const Report& report) {
  for (size_t first = 0; first < hits.size(); first += kRefineSlice) {
    const size_t count = std::min(kRefineSlice, hits.size() - first);
    addRays(hits.subspan(first, count), counts.samples, to,
            std::span(counts.pixels).subspan(first, count));
    const double share = static_cast<double>(first + count) / static_cast<double>(hits.size());
    report(counts.samples + share * (to - counts.samples));
  }
  counts.samples = to;
}

}  // namespace

Estimate refine(const std::string& name, std::span<const trace::Hit> hits, const AddRays& addRays,
                const Goal& goal, Cache& cache, ProgressStyle progress) {
  const Clock::time_point start = Clock::now();
  const Interruption interruption;
  Counts counts = cache.load(hits.size());
  Estimate estimate{.values = {}, .kept = counts.samples};
  const auto surfaces = static_cast<double>(
      std::ranges::count_if(hits, [](const trace::Hit& hit) { return hit.viewDepth > 0; }));
  Saver saver(cache);
  saver.isSaved(counts.samples);
  Progress bar(name, progress);
  for (;;) {
    estimate.values = trace::visibilityOf(hits, counts.pixels);
    estimate.error = trace::rmsError(hits, estimate.values);
    estimate.samples = counts.samples;
    // Does not stop before every sequence has two rays, which a reliable error needs.
    const bool good =
        counts.samples >= trace::kScrambles * 2 && estimate.error <= goal.error && goal.error > 0;
    if (counts.samples >= goal.samples || good || Interruption::asked()) break;
    const uint32_t to = std::min(goal.samples, counts.samples + kPassRays);
    const double expected = expectedSamples(goal, counts.samples, estimate.error);
    castPass(hits, addRays, counts, to, [&](double done) {
      bar.show({.done = done - estimate.kept,
                .total = std::max<double>(expected, to) - estimate.kept,
                .text = progressText(goal, done, estimate.error)});
    });
    saver.saveIfDue(counts);
  }
  saver.save(counts);
  estimate.seconds = secondsSince(start);
  estimate.rays = surfaces * (counts.samples - estimate.kept);
  bar.clear();
  if (Interruption::asked()) {
    fmt::print(stderr, "note: interrupted; {} of {} samples per pixel of {} are {}\n",
               counts.samples, goal.samples, name, cache.file().empty() ? "lost" : "cached");
    throw Interrupted();
  }
  return estimate;
}

std::string summaryOf(const std::string& name, const Estimate& estimate) {
  std::string line = fmt::format("{}: {} samples per pixel", name, estimate.samples);
  if (estimate.kept > 0) line += fmt::format(" ({} of them from the cache)", estimate.kept);
  line += fmt::format(", rms standard error {:.5f}, {:.2f} s", estimate.error, estimate.seconds);
  if (estimate.rays == 0) return line + ", no rays cast";
  return line +
         fmt::format(", {:.2f} million rays per second", estimate.rays / estimate.seconds * 1e-6);
}

}  // namespace grisaille::app::truth
