// SPDX-License-Identifier: MIT
#include "core/trace/flicker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/trace/projection.h"

namespace grisaille::trace {
namespace {

void requireShape(const FlickerFrame& frame, const image::Image& first) {
  for (const image::Image* image : {&frame.ao, &frame.truth}) {
    const bool fits = image->width == first.width && image->height == first.height &&
                      image->channels == 1 && image->pixels.size() == first.pixels.size();
    if (!fits || frame.hits.size() != first.pixels.size()) {
      throw Error(
          ErrorId::kImageMismatch,
          "a flicker frame has {} x {} pixels, {} channels and {} hits; the first frame has "
          "{} x {} pixels, and all need 1 channel and 1 hit per pixel",
          image->width, image->height, image->channels, frame.hits.size(), first.width,
          first.height);
    }
  }
}

// Returns the pixel of `frame` that shows the point, or nothing if the point is not visible.
std::optional<size_t> pixelOf(const glm::dvec3& world, const FlickerFrame& frame,
                              const Projection& projection, double tolerance) {
  const glm::dvec3 p = projection.place(world);
  if (!(p.z > frame.camera.nearPlane)) return {};
  const glm::dvec2 drawn = glm::floor(projection.draw(p));
  if (!(drawn.x >= 0 && drawn.y >= 0 && drawn.x < frame.ao.width && drawn.y < frame.ao.height)) {
    return {};
  }
  const size_t q = static_cast<size_t>(drawn.y) * frame.ao.width + static_cast<size_t>(drawn.x);
  const FacetPlane plane(frame.hits[q], projection);
  if (plane.offset == 0) return {};
  // View depth of the plane at the same place of the picture, divided by that of the point.
  const double share = plane.offset / glm::dot(plane.normal, p);
  if (!(std::abs(share - 1) <= tolerance)) return {};
  return q;
}

// Calls visit(p, change) for each pixel of `now` whose point is visible in `then`.
template <typename Visit>
void eachChange(const FlickerFrame& now, const FlickerFrame& then, double tolerance,
                const Visit& visit) {
  const Projection projection(then.camera, then.ao.width, then.ao.height);
  for (size_t p = 0; p < now.hits.size(); ++p) {
    if (now.hits[p].viewDepth == 0) continue;
    const auto q = pixelOf(now.hits[p].position, then, projection, tolerance);
    if (!q) continue;
    const double change = double{then.ao.pixels[*q]} - double{now.ao.pixels[p]};
    const double due = double{then.truth.pixels[*q]} - double{now.truth.pixels[p]};
    if (std::isfinite(change - due)) visit(p, change - due);
  }
}

}  // namespace

Flicker flicker(std::span<const FlickerFrame> frames, double tolerance) {
  Flicker result;
  double squares = 0;
  for (const FlickerFrame& frame : frames) requireShape(frame, frames[0].ao);
  for (size_t i = 0; i + 1 < frames.size(); ++i) {
    eachChange(frames[i], frames[i + 1], tolerance, [&](size_t, double change) {
      squares += change * change;
      ++result.points;
    });
  }
  double errors = 0;
  uint64_t pixels = 0;
  for (size_t i = 1; i < frames.size(); ++i) {
    for (size_t p = 0; p < frames[i].ao.pixels.size(); ++p) {
      const double error = double{frames[i].ao.pixels[p]} - double{frames[i].truth.pixels[p]};
      if (!std::isfinite(error)) continue;
      errors += error * error;
      ++pixels;
    }
  }
  if (pixels > 0) result.error = std::sqrt(errors / static_cast<double>(pixels));
  if (result.points > 0) result.rms = std::sqrt(squares / static_cast<double>(result.points));
  return result;
}

image::Image changeBetween(const FlickerFrame& now, const FlickerFrame& then, double tolerance) {
  for (const FlickerFrame* frame : {&now, &then}) requireShape(*frame, now.ao);
  image::Image map = now.ao;
  std::ranges::fill(map.pixels, std::numeric_limits<float>::quiet_NaN());
  eachChange(now, then, tolerance,
             [&](size_t p, double change) { map.pixels[p] = static_cast<float>(change); });
  return map;
}

}  // namespace grisaille::trace
