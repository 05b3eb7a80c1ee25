// SPDX-License-Identifier: MIT
#include "lab/claims/regions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/trace/projection.h"

namespace grisaille::lab::claims {
namespace {

using Mask = std::vector<uint8_t>;

constexpr uint32_t kFlatMargin = 8, kEdgeMargin = 4, kConvexMargin = 3;
constexpr double kOpen = 0.99;       // least truth of `open`
constexpr double kJump = 0.1;        // depth edge, radii
constexpr double kSameFacet = 10;    // degrees
constexpr double kConvexAngle = 30;  // degrees

constexpr std::array kRegions = {
    RegionInfo{"all", "every pixel that sees a surface"},
    RegionInfo{"open", "truth of at least 0.99"},
    RegionInfo{"painted", "inside the ray-traced mask of the paint"},
    RegionInfo{"flat", "no depth edge, and no edge of facets over 10 degrees, within 8 pixels"},
    RegionInfo{"edges",
               "within 4 pixels of a depth edge: neighbours a tenth of the radius off each other's "
               "planes"},
    RegionInfo{"convex", "within 3 pixels of an edge at which facets fall away by over 30 degrees"},
    RegionInfo{
        "behind",
        "open, and as near on the screen as the radius reaches to the silhouette of an object that "
        "is nearer by more than the radius"},
    RegionInfo{"beside", "rests, within the radius of a visible surface that moves"},
    RegionInfo{"near", "view depth up to the claim's distance"},
    RegionInfo{"far", "view depth over the claim's distance"}};

bool seen(const trace::Hit& hit) {
  return hit.viewDepth > 0;
}

double degreesBetween(const trace::Hit& a, const trace::Hit& b) {
  return glm::degrees(std::acos(std::clamp(glm::dot(a.facetNormal, b.facetNormal), -1.0, 1.0)));
}

// Height of `other` above the plane of the hit `plane`, in metres.
double height(const trace::Hit& plane, const trace::Hit& other) {
  return glm::dot(plane.facetNormal, other.position - plane.position);
}

bool jumps(const trace::Hit& a, const trace::Hit& b, double radius) {
  if (!seen(a) || !seen(b)) return seen(a) != seen(b);
  return std::min(std::abs(height(a, b)), std::abs(height(b, a))) > kJump * radius;
}

bool bends(const trace::Hit& a, const trace::Hit& b) {
  return seen(a) && seen(b) && degreesBetween(a, b) > kSameFacet;
}

bool fallsAway(const trace::Hit& a, const trace::Hit& b, double radius) {
  return seen(a) && seen(b) && !jumps(a, b, radius) && degreesBetween(a, b) > kConvexAngle &&
         height(a, b) < 0 && height(b, a) < 0;
}

// Calls f(p, q) for every pair of neighbours in a row or a column.
template <typename F>
void eachPair(const trace::FlickerFrame& frame, const F& f) {
  const size_t width = frame.truth.width, height = frame.truth.height;
  for (size_t y = 0; y < height; ++y) {
    for (size_t x = 0; x < width; ++x) {
      const size_t p = y * width + x;
      if (x + 1 < width) f(p, p + 1);
      if (y + 1 < height) f(p, p + width);
    }
  }
}

// Both pixels of every pair of neighbours for which `test` holds, widened by `margin`.
template <typename Test>
Mask about(const trace::FlickerFrame& frame, uint32_t margin, const Test& test) {
  Mask mask(frame.hits.size(), 0);
  eachPair(frame, [&](size_t p, size_t q) {
    if (test(frame.hits[p], frame.hits[q])) mask[p] = mask[q] = 1;
  });
  return widened(mask, frame.truth.width, frame.truth.height, margin);
}

// Pixels whose radius, projected to the screen, reaches across a silhouette.
Mask openBehind(const trace::FlickerFrame& frame, double radius) {
  const auto width = static_cast<int>(frame.truth.width),
             height = static_cast<int>(frame.truth.height);
  const trace::Projection projection(frame.camera, frame.truth.width, frame.truth.height);
  Mask mask(frame.hits.size(), 0);
  eachPair(frame, [&](size_t p, size_t q) {
    const trace::Hit &a = frame.hits[p], &b = frame.hits[q];
    if (!seen(a) || !seen(b) || !jumps(a, b, radius)) return;
    const double behind = std::min(a.viewDepth, b.viewDepth) + radius;
    // The surface behind is farther: its radius covers fewer pixels.
    const int margin = static_cast<int>(std::min(radius * projection.scaleAt(behind), 16384.0));
    const int x = static_cast<int>(p) % width, y = static_cast<int>(p) / width;
    for (int v = std::max(y - margin, 0); v <= std::min(y + margin, height - 1); ++v) {
      for (int u = std::max(x - margin, 0); u <= std::min(x + margin, width - 1); ++u) {
        const size_t i = static_cast<size_t>(v) * frame.truth.width + static_cast<size_t>(u);
        const double depth = frame.hits[i].viewDepth;
        const bool reaches =
            std::max(std::abs(u - x), std::abs(v - y)) <= radius * projection.scaleAt(depth);
        if (depth > behind && reaches && frame.truth.pixels[i] >= kOpen) mask[i] = 1;
      }
    }
  });
  return mask;
}

// Pixels of surfaces that rest, within `radius` of a visible one that moves.
Mask besideMoved(const trace::FlickerFrame& frame, const RegionScale& scale) {
  constexpr size_t kStep = 5;  // of the pixels that move, one in five
  std::vector<glm::dvec3> moved;
  const auto moves = [&](const trace::Hit& hit) {
    return hit.instance < scale.moved.size() && scale.moved[hit.instance] != 0;
  };
  for (size_t i = 0; i < frame.hits.size(); ++i) {
    if (i % kStep == 0 && seen(frame.hits[i]) && moves(frame.hits[i])) {
      moved.push_back(frame.hits[i].position);
    }
  }
  Mask mask(frame.hits.size(), 0);
  for (size_t i = 0; i < mask.size(); ++i) {
    const trace::Hit& hit = frame.hits[i];
    if (!seen(hit) || moves(hit)) continue;
    mask[i] = std::ranges::any_of(moved, [&](const glm::dvec3& place) {
      return glm::distance(place, hit.position) < scale.radius;
    });
  }
  return mask;
}

template <typename Test>
Mask where(const trace::FlickerFrame& frame, const Test& test) {
  Mask mask(frame.hits.size(), 0);
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = test(i) ? 1 : 0;
  return mask;
}

Mask oneRegion(std::string_view name, const trace::FlickerFrame& frame, const RegionScale& scale) {
  const auto jump = [&](const trace::Hit& a, const trace::Hit& b) {
    return jumps(a, b, scale.radius);
  };
  if (name == "edges") return about(frame, kEdgeMargin, jump);
  if (name == "convex") {
    return about(frame, kConvexMargin, [&](const trace::Hit& a, const trace::Hit& b) {
      return fallsAway(a, b, scale.radius);
    });
  }
  if (name == "beside") return besideMoved(frame, scale);
  if (name == "behind") return openBehind(frame, scale.radius);
  if (name == "flat") {
    const Mask edges = about(frame, kFlatMargin, [&](const trace::Hit& a, const trace::Hit& b) {
      return jump(a, b) || bends(a, b);
    });
    return where(frame, [&](size_t i) { return edges[i] == 0; });
  }
  if (name == "open" || name == "painted") {
    return where(frame, [&](size_t i) { return frame.truth.pixels[i] >= kOpen; });
  }
  if (name == "near") {
    return where(frame, [&](size_t i) { return frame.hits[i].viewDepth <= scale.distance; });
  }
  if (name == "far") {
    return where(frame, [&](size_t i) { return frame.hits[i].viewDepth > scale.distance; });
  }
  return Mask(frame.hits.size(), 1);
}

}  // namespace

std::span<const RegionInfo> regions() {
  return kRegions;
}

Mask regionOf(std::string_view names, const trace::FlickerFrame& frame, const RegionScale& scale) {
  Mask all = where(frame, [&](size_t i) { return seen(frame.hits[i]); });
  for (size_t from = 0; from <= names.size();) {
    const size_t end = std::min(names.find('+', from), names.size());
    const Mask one = oneRegion(names.substr(from, end - from), frame, scale);
    for (size_t i = 0; i < all.size(); ++i) all[i] = all[i] & one[i];
    from = end + 1;
  }
  return all;
}

Mask widened(const Mask& mask, uint32_t width, uint32_t height, uint32_t margin) {
  // First along the rows, then along the columns.
  const auto along = [margin](const Mask& from, size_t lines, size_t count, size_t line,
                              size_t step) {
    Mask to(from.size(), 0);
    for (size_t l = 0; l < lines; ++l) {
      for (size_t i = 0; i < count; ++i) {
        if (from[l * line + i * step] == 0) continue;
        const size_t last = std::min(i + margin, count - 1);
        for (size_t k = i - std::min<size_t>(i, margin); k <= last; ++k)
          to[l * line + k * step] = 1;
      }
    }
    return to;
  };
  return along(along(mask, height, width, width, 1), width, height, 1, width);
}

}  // namespace grisaille::lab::claims
