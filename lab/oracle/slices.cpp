// SPDX-License-Identifier: MIT
// The estimator `slices`: steps 1 to 8 of effects/ssao/README.md.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <optional>

#include "lab/oracle/facet.h"
#include "lab/oracle/history.h"
#include "lab/oracle/occlusion.h"

namespace grisaille::lab::oracle {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kGolden = 0.618034;  // offset between a pixel's slices, golden ratio
// Upper limits of the tolerance: between texels and in the upsampling, texels; at full resolution,
// pixels.
constexpr double kTexelTolerance = 0.75, kBetweenTolerance = 0.375, kRefinedTolerance = 1;
constexpr int kListedSteps = 5;         // taps on each side, at full resolution
constexpr double kFewest = 3;           // least sum of weights at full resolution
constexpr double kSteepest = 6.5;       // slope of a surface that taps share, if backs are known
constexpr double kLone = 2.5;           // reach of a surface of one tap, distances between taps
constexpr double kLoneAboveNext = 1.5;  // if the surface behind is known
constexpr double kNextThickness = 0.1;  // of the solid behind the back, in thicknesses
constexpr double kTapPower = 1.5;       // distances of taps grow with this power of their number
constexpr double kBeyondBorder = 2;  // steps that a surface goes on for each tap beyond the border
// Share of a fitted line's change that is taken, and least variance of offsets, texels^2.
constexpr double kFitted = 0.5, kLeastSpread = 0.5;
// Where pixels begin to be refined, and where they are refined entirely: share of texels on the
// pixel's plane, and difference of visibility between texels over the parameter `contrast`.
constexpr double kServed[] = {0.5, 0.3}, kContrast[] = {0.8, 1.2};

// A slice of the hemisphere over a surface. Angles start at the view vector, and are positive on
// the side of `across`.
struct Slice {
  glm::dvec3 tangent, up;  // the surface's axes in the slice
  double normal = 0;       // the projected normal's angle

  // Cosine-weighted solid angle between the view vector and `angle`, on the side of its sign.
  double between(double angle) const {
    const double side = angle < 0 ? -1 : 1, h = std::abs(angle), n = side * normal;
    return (std::cos(n) - std::cos(2 * h - n)) / 4 + h * std::sin(n) / 2;
  }
  // The share of the slice below an angle.
  double below(double angle) const {
    const double behind = between(normal - kPi / 2), ahead = between(normal + kPi / 2);
    const double part = between(angle);
    return (behind + (angle < 0 ? -part : part)) / (behind + ahead);
  }
  // The cosine-weighted mean of 16 directions, without those in occluded sectors (bits of `shut`).
  glm::dvec3 meanOpen(const glm::dvec3& across, const glm::dvec3& toward, uint32_t shut) const {
    glm::dvec3 sum(0);
    for (int i = 0; i < 16; ++i) {
      const double angle = normal + ((i + 0.5) / 16 - 0.5) * kPi;
      const int sector = std::clamp(static_cast<int>(below(angle) * 32), 0, 31);
      if ((shut >> sector & 1) != 0) continue;
      const double weight = std::abs(std::sin(angle)) * std::cos(angle - normal);
      sum += weight * (across * std::sin(angle) + toward * std::cos(angle));
    }
    return sum * (kPi / 16 / (between(normal - kPi / 2) + between(normal + kPi / 2)));
  }
  // The share of the slice below the direction of a point on one side (1 or -1) of the view vector.
  double below(const glm::dvec3& point, double side) const {
    const double height = glm::dot(point, up);
    if (height <= 0) return side > 0 ? 1 : 0;
    double along = side * glm::dot(point, tangent);
    const double c = std::cos(normal), s = side * std::sin(normal);
    if (along * c + height * s < 0) along = std::abs(along);
    const double out = std::max(along * c + height * s, 0.0), towards = height * c - along * s;
    const double part = between(side * std::atan2(out, towards));
    const double behind = between(normal - kPi / 2), ahead = between(normal + kPi / 2);
    return (behind + side * part) / (behind + ahead);
  }
};

// The state of one side of a slice while its taps proceed outwards.
struct Walk {
  double side;                    // 1 or -1
  double share;                   // share of the slice below the previous tap
  glm::dvec3 point{0}, step{0};   // the previous tap, and the step that led to it
  std::optional<double> depth{};  // of the previous tap, if the next may be joined to it
  double beyond = 0;              // of the previous tap: squared distance - squared radius
  double farther = 1;             // how much larger than that of the tap before it
  int seen = 0;                   // number of taps inside the attachments
  glm::dvec2 at{0};               // pixel of the previous tap
};

// Values of a texel: the mean open direction in view space, of any length, and the visibility.
using Texel = glm::dvec4;
const Texel kSky(0, 0, 0, 1);

// A weighted mean of texels. A line that is fitted through their visibility along each axis says
// how much it changes from their middle to the centre.
class LineFit {
 public:
  void add(double weight, const glm::dvec2& across, const Texel& texel) {
    sum_ += weight * texel;
    weights_ += weight;
    offsets_ += weight * across;
    squares_ += weight * across * across;
    products_ += weight * across * texel.w;
  }
  // Adds `texel` at the centre, up to a sum of weights of `least`.
  void fill(double least, const Texel& texel) {
    add(std::max(least - weights_, 0.0), glm::dvec2(0), texel);
  }
  Texel centre() const {
    Texel mean = sum_ / weights_;
    const glm::dvec2 offset = offsets_ / weights_;
    const glm::dvec2 spread = glm::max(squares_ / weights_ - offset * offset, kLeastSpread);
    const glm::dvec2 slope = (products_ / weights_ - offset * mean.w) / spread;
    mean.w = std::clamp(mean.w - kFitted * glm::dot(offset, slope), 0.0, 1.0);
    return mean;
  }

 private:
  Texel sum_{0};
  double weights_ = 0;
  glm::dvec2 offsets_{0}, squares_{0}, products_{0};
};

// A pixel's value between the texels, and the share of it that one at full resolution replaces.
struct Upsampled {
  Texel texel = kSky;
  double share = 0;
};

// 0 at the first value of `range`, 1 at the second.
double linearStep(const double (&range)[2], double value) {
  return std::clamp((value - range[0]) / (range[1] - range[0]), 0.0, 1.0);
}

class Slices : public Occlusion {
 public:
  Slices(const View& view, const OcclusionSettings& settings, std::shared_ptr<const PastFrame> past)
      : view_(view),
        settings_(settings),
        thickness_(static_cast<float>(settings.radius) * static_cast<float>(settings.thickness)),
        texels_((view.size() + settings.scale - 1) / settings.scale),
        past_(std::move(past)),
        frames_(past_ ? past_->frames : 0),
        raw_(texels_,
             [this](const glm::ivec2& t) { return estimate(t, settings_.scale, frames_, false); }),
        rows_(texels_,
              [this](const glm::ivec2& t) {
                return denoised([this](const glm::ivec2& at) { return raw_(at); }, t, {1, 0});
              }),
        columns_(texels_,
                 [this](const glm::ivec2& t) {
                   return denoised([this](const glm::ivec2& at) { return rows_(at); }, t, {0, 1});
                 }),
        edges_(texels_, [this](const glm::ivec2& t) { return alongEdge(t); }),
        means_(texels_, [this](const glm::ivec2& t) { return mean(t); }),
        upsampled_(view.size(), [this](const glm::ivec2& p) { return upsampled(p); }),
        refined_(view.size(), [this](const glm::ivec2& p) { return estimate(p, 1, 0, true); }) {}

  double visibility(const glm::ivec2& pixel) override { return finished(at(pixel).w, settings_); }
  glm::dvec3 bentNormal(const glm::ivec2& pixel) override {
    const glm::dvec3 mean(at(pixel));
    if (!(glm::dot(mean, mean) > 1e-8)) return view_.worldNormal(pixel);
    return glm::transpose(view_.viewFromWorld()) * glm::normalize(mean);
  }
  std::shared_ptr<const Past> past() override {
    return std::make_shared<PastFrame>(view_, settings_.scale, frames_ + 1, means_);
  }

 private:
  Texel at(const glm::ivec2& pixel) {
    if (view_.depth(pixel) <= 0) return kSky;
    if (settings_.scale == 1) return averaged(pixel);
    return upsampled_(pixel).share > 0 ? refined(pixel) : upsampled_(pixel).texel;
  }
  // The history holds only visibility.
  Texel averaged(const glm::ivec2& texel) {
    const Texel own = filtered(texel);
    return settings_.history > 1 ? Texel(glm::dvec3(own), means_(texel).open) : own;
  }
  Texel filtered(const glm::ivec2& texel) {
    if (settings_.blurSize <= settings_.scale) return raw_(texel);
    return settings_.edgeDenoise > 0 ? edges_(texel) : columns_(texel);
  }
  // Of the texel `at` of a grid with `scale` pixels per texel, after a number of frames. `listed`:
  // a pixel that is computed at full resolution, with twice the slices.
  Texel estimate(const glm::ivec2& at, int scale, int frames, bool listed) const;
  Mean mean(const glm::ivec2& texel);
  bool isEdge(const glm::ivec2& pixel) const;
  Texel sliceOf(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& direction,
                const glm::dvec2& pixel, double dither, int steps) const;
  uint32_t tap(const Slice& slice, const glm::dvec3& position, const glm::ivec2& at, double dither,
               bool next, Walk& walk) const;
  Texel denoised(const std::function<Texel(const glm::ivec2&)>& from, const glm::ivec2& texel,
                 const glm::ivec2& along) const;
  Texel alongEdge(const glm::ivec2& texel);
  Upsampled upsampled(const glm::ivec2& pixel);
  Texel refined(const glm::ivec2& pixel);

  // Of the pixel that a texel samples.
  Facet facetAt(const glm::ivec2& pixel, double pixels) const {
    return Facet(view_, pixel, pixels, settings_.radius, true);
  }
  // Taps on each side of a slice if `slices` share those of a pixel.
  int stepsOf(int slices) const { return (settings_.kernelSize + 2 * slices - 1) / (2 * slices); }
  double texelTolerance() const { return kTexelTolerance * settings_.scale; }

  const View& view_;
  OcclusionSettings settings_;
  double thickness_;  // metres
  glm::ivec2 texels_;
  std::shared_ptr<const PastFrame> past_;
  int frames_;  // number of frames before this one
  Lazy<Texel> raw_;
  Lazy<Texel> rows_, columns_, edges_;
  Lazy<Mean> means_;
  Lazy<Upsampled> upsampled_;
  Lazy<Texel> refined_;  // before their denoiser
};

Mean Slices::mean(const glm::ivec2& texel) {
  const double now = filtered(texel).w;
  const glm::ivec2 pixel = texel * settings_.scale;
  if (!past_ || view_.depth(pixel) <= 0) return {.open = now};
  const glm::dvec3 place =
      view_.eye() + glm::transpose(view_.viewFromWorld()) * view_.position(pixel);
  const Mean old = past_->seenAt(place, view_.worldNormal(pixel));
  const double frames = std::min(old.frames, settings_.history - 1.0);
  return {.open = (old.open * frames + now) / (frames + 1), .frames = frames + 1};
}

uint32_t sectors(double low, double high, double dither) {
  const auto from = static_cast<uint32_t>(std::clamp(low * 32 + dither, 0.0, 32.0));
  const auto to = static_cast<uint32_t>(std::clamp(high * 32 + dither, 0.0, 32.0));
  uint32_t bits = 0;
  for (uint32_t i = from; i < to; ++i) bits |= 1u << i;
  return bits;
}

// Whether fewer than 7 of the 8 texels at distance 2 lie within half the plane tolerance.
bool Slices::isEdge(const glm::ivec2& pixel) const {
  const Facet facet = facetAt(pixel, texelTolerance());
  int same = 0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const glm::ivec2 other = pixel + glm::ivec2(x, y) * 2 * settings_.scale;
      if (other != pixel && facet.off(view_, other, view_.depth(other)) < 0.5) ++same;
    }
  }
  return same < 7;
}

Texel Slices::estimate(const glm::ivec2& texel, int scale, int frames, bool listed) const {
  const glm::ivec2 pixel = texel * scale;
  if (view_.depth(pixel) <= 0) return kSky;
  glm::dvec3 normal = view_.normal(pixel);
  const std::optional<Raised> raised = raisedBy(view_, pixel, normal, settings_.bias);
  if (!raised) return kSky;
  const glm::dvec3 position = raised->position;
  const glm::dvec3 toward = view_.toward(position);
  const double facing = glm::dot(normal, toward);
  normal = glm::normalize(normal + toward * std::max((facing < -1e-3 ? 1e-2 : 1e-3) - facing, 0.0));
  // A block of 5x5 texels holds the 25 points of a Hammersley set. Each frame of a history takes
  // another of the points.
  const int drawn = static_cast<int>(frames % 25);
  const int first = (2 * texel.x + texel.y + 2 * drawn) % 5;
  const int second = (texel.x + 2 * texel.y + drawn + 2 * (drawn / 5)) % 5;
  const double turn = std::fmod(0.375 + (settings_.seed + frames / 25) * 0.6180339887498949, 1.0);
  const glm::dmat3 axes = axesAbout(normal);
  const bool edge = settings_.edgeSlices > 1 && !listed && isEdge(pixel);
  const int slices = settings_.slices * (listed ? 2 : edge ? settings_.edgeSlices : 1);
  int steps = stepsOf(settings_.slices);
  if (listed) steps = std::max(stepsOf(slices), std::min(steps, kListedSteps));
  Texel sum(0);
  for (int k = 0; k < slices; ++k) {
    const double phi = (k + (first * 5 + second + turn) / 25) / slices * 2 * kPi;
    const double place = (second * 5 + first + 0.5) / 25 + k * kGolden;
    const double u = place - std::floor(place);
    const double r = std::sqrt(u);
    const glm::dvec3 direction =
        axes * glm::dvec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u));
    sum += sliceOf(position, normal, direction, raised->pixel, u, steps);
  }
  return sum / static_cast<double>(slices);
}

Texel Slices::sliceOf(const glm::dvec3& position, const glm::dvec3& normal,
                      const glm::dvec3& direction, const glm::dvec2& pixel, double dither,
                      int steps) const {
  const glm::dvec3 toward = view_.toward(position);
  glm::dvec3 across = direction - toward * glm::dot(direction, toward);
  across /= std::sqrt(std::max(glm::dot(across, across), 1e-12));
  const double out = glm::dot(normal, across), up = glm::dot(normal, toward);
  Slice slice;
  slice.normal = std::atan2(out, up);
  slice.tangent = across * std::cos(slice.normal) - toward * std::sin(slice.normal);
  slice.up = normal / std::sqrt(std::max(out * out + up * up, 1e-4));

  // The slice's line in the picture, and the taps on it. They reach as far as the view ray that
  // touches the sphere. Tap i is at least i + 1 pixels away, and distant taps fall on a grid.
  const double shrink = view_.shrink(-position.z), square = settings_.radius * settings_.radius;
  glm::dvec2 way = glm::dvec2(across) * view_.focal();
  if (!view_.orthographic()) {
    way = (glm::dvec2(across) * shrink + glm::dvec2(position) * across.z) * view_.focal();
  }
  const double stretch = glm::dot(way, way);
  way /= std::sqrt(std::max(stretch, 1e-20));
  const double cut =
      view_.orthographic() ? 1 : std::max(1 - square / glm::dot(position, position), 0.0625);
  const double reach = settings_.radius / (shrink * shrink) * std::sqrt(stretch / cut);
  Walk ahead{.side = 1, .share = 1, .beyond = -square, .at = pixel};
  // Unless backs are drawn, the first tap may be joined to the pixel's own surface.
  if (settings_.backs < OcclusionSettings::Backs::kDrawn) ahead.depth = -position.z;
  Walk behind = ahead;
  behind.side = -1;
  behind.share = 0;
  Walk nextAhead = ahead, nextBehind = behind;
  uint32_t shut = 0;
  const uint32_t finer = std::max(8u, std::bit_ceil(static_cast<uint32_t>(steps)) / 2);
  for (int i = 0; i < steps; ++i) {
    for (Walk* walk : {&ahead, &behind}) {
      const double at = (i + (walk->side > 0 ? dither : 1 - dither)) / steps;
      const double pixels = std::max(std::pow(at, kTapPower) * reach, i + 1.0);
      const double grid = std::max(std::exp2(std::floor(std::log2(pixels))) / finer, 1.0);
      const glm::dvec2 place = glm::clamp(
          glm::floor((pixel + walk->side * pixels * way) / grid + 0.5) * grid, -1e6, 1e6);
      shut |= tap(slice, position, glm::ivec2(place), dither, false, *walk);
      if (settings_.backs == OcclusionSettings::Backs::kPeeled) {
        Walk& next = walk == &ahead ? nextAhead : nextBehind;
        shut |= tap(slice, position, glm::ivec2(place), dither, true, next);
      }
    }
  }
  for (const Walk* walk : {&ahead, &behind}) {
    if (!walk->depth) continue;
    // The surface of the last tap goes on until it leaves the sphere, at most one step further, and
    // more if taps lie beyond the border.
    const double most = 1 + kBeyondBorder * (steps - walk->seen);
    const double more = std::min(-walk->beyond / std::max(walk->farther, 1e-30), most);
    const double share = slice.below(walk->point + more * walk->step, walk->side);
    shut |= sectors(std::min(walk->share, share), std::max(walk->share, share), dither);
  }
  const glm::dvec3 bent = slice.meanOpen(across, toward, shut);
  return {bent, 1 - std::popcount(shut) / 32.0};
}

uint32_t Slices::tap(const Slice& slice, const glm::dvec3& position, const glm::ivec2& at,
                     double dither, bool next, Walk& walk) const {
  if (!view_.holds(at)) return 0;
  const double depth = next ? view_.next(at) : view_.depth(at);
  const glm::dvec3 ray = view_.ray(glm::dvec2(at) + 0.5);
  const glm::dvec3 front = view_.position(at, depth) - position, step = front - walk.point;
  bool joined = walk.depth && std::abs(depth - *walk.depth) < thickness_;
  const double beyond = glm::dot(front, front) - settings_.radius * settings_.radius;
  const bool inside = beyond <= 0;
  glm::dvec3 wide(0);
  using Backs = OcclusionSettings::Backs;
  if (settings_.backs != Backs::kAssumed) {
    const glm::dvec2 across = view_.shrink(depth) * (glm::dvec2(at) - walk.at) / view_.focal();
    joined = joined && std::abs(depth - *walk.depth) < kSteepest * glm::length(across);
    if (inside && !joined && !next && walk.seen > 0) {
      wide = (settings_.backs == Backs::kPeeled ? kLoneAboveNext : kLone) * glm::dvec3(across, 0);
      wide -= slice.up * (glm::dot(wide, slice.up) / glm::dot(slice.up, slice.up));
    }
  }
  const double first = slice.below(front - wide, walk.side);
  uint32_t bits = 0;
  bool present = false;
  double from = first;
  if (joined && !inside) {
    present = depth > 0;
    // Where the squared distance, taken as linear between the taps, is the squared radius.
    const double inner = walk.beyond / (walk.beyond - beyond);
    const double last = slice.below(walk.point + inner * step, walk.side);
    bits = sectors(std::min(walk.share, last), std::max(walk.share, last), dither);
  } else {
    // The part of front + k ray, k in [0, matter], inside the sphere.
    double matter = next ? kNextThickness * thickness_ : thickness_;
    if (!next && settings_.backs >= Backs::kDrawn && view_.back(at) > 0)
      matter = std::max(view_.back(at) - depth, 0.0);
    if (settings_.backs == Backs::kBodies && view_.thickness(at) >= 0) matter = view_.thickness(at);
    const double length = glm::dot(ray, ray), b = glm::dot(ray, front) / length;
    const double d = b * b - beyond / length;
    const double root = std::sqrt(std::max(d, 0.0));
    const double near = std::max(0.0, -b - root), far = std::min(matter, root - b);
    present = depth > 0 && d > 0 && near <= far;
    from = slice.below(front + near * ray - wide, walk.side);
    const double last = slice.below(front + far * ray + wide, walk.side);
    const double low = joined ? std::min(from, walk.share) : from;
    const double high = joined ? std::max(from, walk.share) : from;
    bits = sectors(std::min(low, last), std::max(high, last), dither);
  }
  walk.step = joined ? step : glm::dvec3(0);
  walk.point = front;
  walk.farther = beyond - walk.beyond;
  walk.beyond = beyond;
  walk.share = from;
  walk.depth = present && inside ? std::optional(depth) : std::nullopt;
  ++walk.seen;
  walk.at = at;
  return present ? bits : 0;
}

Texel Slices::denoised(const std::function<Texel(const glm::ivec2&)>& from, const glm::ivec2& texel,
                       const glm::ivec2& along) const {
  const double width = std::max(static_cast<double>(settings_.blurSize) / settings_.scale, 1.0);
  const int reach = static_cast<int>(std::ceil(width));
  const glm::ivec2 surface = texel * settings_.scale;
  if (view_.depth(surface) <= 0) return kSky;
  const Facet facet = facetAt(surface, texelTolerance());
  LineFit fit;
  for (int i = 1 - reach; i < reach; ++i) {
    const glm::ivec2 other = texel + along * i;
    const glm::ivec2 inside = glm::clamp(other, glm::ivec2(0), texels_ - 1);
    const double depth = view_.depth(inside * settings_.scale);
    if (depth <= 0) continue;
    const double apart = facet.off(view_, other * settings_.scale, depth);
    const double weight = (width - std::abs(i)) * std::max(1 - apart, 0.0);
    fit.add(weight, along * i, from(inside));
  }
  return fit.centre();
}

// The mean of texels along an edge, weighted by how clear the edge's direction is.
Texel Slices::alongEdge(const glm::ivec2& texel) {
  const glm::ivec2 surface = texel * settings_.scale;
  const Texel own = columns_(texel);
  if (view_.depth(surface) <= 0) return own;
  const Facet facet = facetAt(surface, texelTolerance());
  const auto offAt = [&](const glm::ivec2& across) {
    const glm::ivec2 at = glm::clamp(texel + across, glm::ivec2(0), texels_ - 1);
    const double depth = view_.depth(at * settings_.scale);
    return depth > 0 ? facet.off(view_, (texel + across) * settings_.scale, depth) : 1e9;
  };
  glm::dvec2 moments(0);  // cosine and sine of twice the angle
  for (const glm::ivec2 way : {glm::ivec2(1, 2), {2, 1}, {-1, 2}, {-2, 1}}) {
    const double off = std::min(2 * offAt(way), 1.0) + std::min(2 * offAt(-way), 1.0);
    const double angle = 2 * std::atan2(way.y, way.x);
    moments += off * glm::dvec2(std::cos(angle), std::sin(angle));
  }
  const double clear = std::clamp(2 * glm::length(moments) - 0.5, 0.0, 1.0);
  if (clear == 0) return own;
  const double angle = (std::atan2(moments.y, moments.x) + kPi) / 2;
  glm::dvec2 along(std::cos(angle), std::sin(angle));
  along /= std::max(std::abs(along.x), std::abs(along.y));
  // The direction's sign matters: it decides ties of rounding.
  if (moments.x < 0 ? along.x < 0 : along.y < 0) along = -along;
  const int reach = settings_.edgeDenoise;
  double weights = reach + 1;
  Texel sum = weights * own;
  for (int i = 2; i <= reach; i += 2) {
    for (const double way : {1.0, -1.0}) {
      const glm::ivec2 across(glm::floor(along * (way * i) + 0.501));
      const double weight = (reach + 1 - i) * std::max(1 - offAt(across), 0.0);
      sum += weight * columns_(glm::clamp(texel + across, glm::ivec2(0), texels_ - 1));
      weights += weight;
    }
  }
  return glm::mix(own, sum / weights, clear);
}

Upsampled Slices::upsampled(const glm::ivec2& pixel) {
  if (view_.depth(pixel) <= 0) return {};
  const int scale = settings_.scale;
  // The four pixels of a 2x2 block blend the same four texels.
  const glm::ivec2 first = pixel / 2 * 2 / scale;
  const glm::dvec2 part = glm::dvec2(pixel - first * scale) / static_cast<double>(scale);
  Texel sum(0);
  double weights = 0, served = 0, least = 1, most = 0;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 corner(i & 1, i >> 1), texel = first + corner;
    const double depth = view_.depth(glm::clamp(texel, glm::ivec2(0), texels_ - 1) * scale);
    if (depth <= 0) continue;
    const glm::ivec2 inside = glm::clamp(texel, glm::ivec2(0), texels_ - 1);
    const double apart =
        facetAt(inside * scale, kBetweenTolerance * scale).off(view_, pixel, view_.depth(pixel));
    const double share =
        (corner.x != 0 ? part.x : 1 - part.x) * (corner.y != 0 ? part.y : 1 - part.y);
    const double onPlane = share * std::max(0.0, 1 - apart);
    const double weight = onPlane + 1e-4 / (1 + apart * apart * apart);
    const Texel value = averaged(texel);
    sum += weight * value;
    weights += weight;
    served += onPlane;
    least = std::min(least, value.w);
    most = std::max(most, value.w);
  }
  using Refine = OcclusionSettings::Refine;
  Upsampled result = {.texel = weights > 0 ? sum / weights : kSky};
  if (settings_.refine != Refine::kNothing) result.share = linearStep(kServed, served);
  if (settings_.refine == Refine::kContrasts)
    result.share =
        std::max(result.share, linearStep(kContrast, (most - least) / settings_.contrast));
  return result;
}

// The mean of the 5x5 pixels around, listed or not.
Texel Slices::refined(const glm::ivec2& pixel) {
  const Facet facet(view_, pixel, kRefinedTolerance, settings_.radius, false);
  LineFit fit;
  for (int i = 0; i < 25; ++i) {
    const glm::ivec2 across(i % 5 - 2, i / 5 - 2);
    const glm::ivec2 other = glm::clamp(pixel + across, glm::ivec2(0), view_.size() - 1);
    if (view_.depth(other) <= 0) continue;
    const double weight = std::max(1 - facet.off(view_, pixel + across, view_.depth(other)), 0.0);
    if (weight <= 0) continue;
    const Upsampled from = upsampled_(other);
    fit.add(weight, across,
            from.share > 0 ? glm::mix(from.texel, refined_(other), from.share) : from.texel);
  }
  const Upsampled own = upsampled_(pixel);
  fit.fill(kFewest, own.texel);
  return glm::mix(own.texel, fit.centre(), own.share);
}

}  // namespace

std::unique_ptr<Occlusion> makeSlices(const View& view, const OcclusionSettings& settings,
                                      std::shared_ptr<const Past> past) {
  return std::make_unique<Slices>(view, settings,
                                  std::dynamic_pointer_cast<const PastFrame>(std::move(past)));
}

}  // namespace grisaille::lab::oracle
