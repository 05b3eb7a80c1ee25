// SPDX-License-Identifier: MIT
#include "lab/claims/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "lab/claims/regions.h"

namespace grisaille::lab::claims {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr uint32_t kSquare = 4;      // pixels per side: holds each rotation of the pattern once
constexpr uint32_t kMaskMargin = 2;  // pixels

constexpr std::array kMetrics = {
    MetricInfo{"mean", "mean of the output", Over::kFirst, false},
    MetricInfo{"bias", "mean error", Over::kFirst, false},
    MetricInfo{"rmse", "root mean square error", Over::kFirst, false},
    MetricInfo{"noise",
               "standard deviation of the error within 4x4 pixels, rms over all squares in the "
               "region; a 4x4 blur removes it",
               Over::kFirst, false},
    MetricInfo{"bands", "rms of the error's mean over 4x4 pixels; a 4x4 blur leaves it",
               Over::kFirst, false},
    MetricInfo{"flicker",
               "rms change of the error from frame to frame, at the same point of the world",
               Over::kAll, false},
    MetricInfo{"swim",
               "rms change of the output from frame to frame, at the same point of the world",
               Over::kAll, false},
    MetricInfo{"moving_rmse", "root mean square error along the path, without its first frame",
               Over::kAll, false},
    MetricInfo{"last_rmse", "root mean square error of the last frame", Over::kLast, false},
    MetricInfo{"mask_outside",
               "share of the painted pixels (alpha over 1/2) that lie more than 2 pixels outside "
               "the ray-traced mask",
               Over::kFirst, false},
    MetricInfo{"milliseconds", "time of the effects' passes, median of the rounds", Over::kFirst,
               true}};

// The picture with NaN outside the region.
image::Image inRegion(const image::Image& picture, const std::vector<uint8_t>& region) {
  image::Image result = picture;
  for (size_t i = 0; i < region.size(); ++i) {
    if (region[i] == 0) result.pixels[i] = static_cast<float>(kNone);
  }
  return result;
}

// Over all 4x4 squares inside the region: the mean square of the error's mean over a square, and
// the mean of the error's variance within a square.
struct Squares {
  double means = 0, variances = 0;
  uint64_t count = 0;
};

Squares squaresOf(const image::Image& shown, const image::Image& reference) {
  Squares result;
  for (uint32_t y = 0; y + kSquare <= shown.height; ++y) {
    for (uint32_t x = 0; x + kSquare <= shown.width; ++x) {
      double sum = 0, squares = 0;
      for (uint32_t i = 0; i < kSquare * kSquare; ++i) {
        const uint32_t px = x + i % kSquare, py = y + i / kSquare;
        const double error = double{shown.at(px, py)} - double{reference.at(px, py)};
        sum += error;
        squares += error * error;
      }
      const double mean = sum / (kSquare * kSquare);
      if (!std::isfinite(mean)) continue;
      result.means += mean * mean;
      result.variances += std::max(squares / (kSquare * kSquare) - mean * mean, 0.0);
      ++result.count;
    }
  }
  return result;
}

// Frame-to-frame change inside the region: of the error, or of the output itself.
trace::Flicker changeAlong(const Evidence& evidence, bool ofError) {
  for (size_t i = 0; i < evidence.frames.size(); ++i) {
    trace::FlickerFrame& frame = evidence.frames[i];
    frame.ao = inRegion(evidence.shown[i], evidence.region[i]);
    frame.truth = evidence.reference[i];
    if (!ofError) std::fill(frame.truth.pixels.begin(), frame.truth.pixels.end(), 0.0f);
  }
  return trace::flicker(evidence.frames);
}

double shareOutside(const Evidence& evidence) {
  const image::Image &shown = evidence.shown[0], &mask = evidence.reference[0];
  std::vector<uint8_t> near(mask.pixels.size());
  for (size_t i = 0; i < near.size(); ++i) near[i] = mask.pixels[i] > 0.5f ? 1 : 0;
  near = widened(near, mask.width, mask.height, kMaskMargin);
  uint64_t painted = 0, outside = 0;
  for (size_t i = 0; i < near.size(); ++i) {
    if (evidence.region[0][i] == 0 || !(shown.pixels[i] > 0.5f)) continue;
    ++painted;
    if (near[i] == 0) ++outside;
  }
  return painted == 0 ? kNone : static_cast<double>(outside) / static_cast<double>(painted);
}

}  // namespace

std::span<const MetricInfo> metrics() {
  return kMetrics;
}

const MetricInfo* findMetric(std::string_view key) {
  for (const MetricInfo& metric : kMetrics) {
    if (key == metric.key) return &metric;
  }
  return nullptr;
}

double measured(std::string_view metric, const Evidence& evidence) {
  if (metric == "flicker" || metric == "swim" || metric == "moving_rmse") {
    const trace::Flicker along = changeAlong(evidence, metric != "swim");
    if (along.points == 0) return kNone;
    return metric == "moving_rmse" ? along.error : along.rms;
  }
  if (metric == "mask_outside") return shareOutside(evidence);
  const size_t frame = metric == "last_rmse" ? evidence.shown.size() - 1 : 0;
  const image::Image shown = inRegion(evidence.shown[frame], evidence.region[frame]);
  image::Image reference = evidence.reference[frame];
  if (metric == "noise" || metric == "bands") {
    const Squares squares = squaresOf(shown, reference);
    const double sum = metric == "noise" ? squares.variances : squares.means;
    return squares.count == 0 ? kNone : std::sqrt(sum / static_cast<double>(squares.count));
  }
  if (metric == "mean") std::fill(reference.pixels.begin(), reference.pixels.end(), 0.0f);
  const image::Difference difference = image::compare(shown, reference);
  if (difference.compared == 0) return kNone;
  return metric.ends_with("rmse") ? difference.rmse : difference.bias;
}

}  // namespace grisaille::lab::claims
