// SPDX-License-Identifier: MIT
#include "core/trace/depth_field.h"

#include <algorithm>
#include <limits>

#include "core/trace/occlusion_rays.h"
#include "core/trace/parallel.h"

namespace grisaille::trace {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Offset of ray origins from the facet, as a fraction of view depth: larger than the rounding of
// double, and far smaller than a pixel.
constexpr double kLift = 1e-7;

// Walks over the columns, or the rows, of the picture that a ray crosses. With a the ray's scaled
// coordinate and w its view depth, the ray crosses the line at `c` pixels from the view axis where
// a = c w. For an orthographic camera, w is 1.
class Walk {
 public:
  // `pixel`: column or row where the ray starts. `centre`: the view axis, pixels.
  Walk(double a, double aStep, double w, double wStep, uint32_t pixel, double centre)
      : a_(a), aStep_(aStep), w_(w), wStep_(wStep), pixel_(pixel), centre_(centre) {
    const double motion = aStep * w - a * wStep;
    step_ = motion > 0 ? 1 : motion < 0 ? -1 : 0;
    find();
  }

  int64_t pixel() const { return pixel_; }
  double next() const { return next_; }  // metres to the next pixel; infinite: none
  void advance() {
    pixel_ += step_;
    find();
  }

 private:
  void find() {
    next_ = kNever;
    if (step_ == 0) return;
    const double line = static_cast<double>(pixel_ + (step_ > 0 ? 1 : 0)) - centre_;
    const double t = (line * w_ - a_) / (aStep_ - line * wStep_);
    // Otherwise the ray crosses the line only behind the eye.
    if (w_ + t * wStep_ > 0) next_ = t;
  }

  double a_, aStep_, w_, wStep_;
  int64_t pixel_;
  double centre_;
  int step_ = 0;
  double next_ = kNever;
};

// Returns whether a ray is inside a pixel's solid anywhere from t0 to t1, metres along the ray. The
// height above the plane, `height`, and view depth, `w`, are linear along the ray. An orthographic
// camera sees a point `height` / normal.z behind the plane.
bool isInside(const FacetPlane& plane, double height, double heightStep, double w, double wStep,
              double thickness, bool orthographic, double t0, double t1) {
  const double h0 = height + t0 * heightStep;
  const double h1 = height + t1 * heightStep;
  if (h0 >= 0 && h1 >= 0) return false;
  if (h0 >= 0 || h1 >= 0) return true;  // the ray crosses the plane
  if (orthographic) return std::max(h0, h1) > thickness * plane.normal.z;
  // At the same place of the picture, the plane's view depth is w offset / (height + offset). The
  // ray is less than `thickness` behind the plane where the expression below is above 0.
  const auto inside = [&](double t) {
    const double h = height + t * heightStep;
    return (w + t * wStep) * h - thickness * (h + plane.offset) > 0;
  };
  if (inside(t0) || inside(t1)) return true;
  const double curve = wStep * heightStep;
  if (curve >= 0) return false;
  const double top = (thickness * heightStep - w * heightStep - height * wStep) / (2 * curve);
  return top > t0 && top < t1 && inside(top);
}

}  // namespace

// A ray in view space, from a pixel's surface.
struct DepthField::Path {
  glm::dvec3 from, direction;
  double length;  // metres
  glm::uvec2 pixel;
};

DepthField::DepthField(std::span<const Hit> hits, const scene::Camera& camera, uint32_t width,
                       uint32_t height)
    : projection_(camera, width, height),
      nearPlane_(camera.nearPlane),
      width_(width),
      height_(height),
      planes_(hits.size()) {
  forEach(hits.size(), [&](size_t i) { planes_[i] = FacetPlane(hits[i], projection_); });
}

bool DepthField::isOpen(const Path& path, double thickness) const {
  const auto& [from, direction, length, pixel] = path;
  const double scale = projection_.scale();
  const glm::dvec2 centre = projection_.centre();
  const bool orthographic = projection_.orthographic();
  const double w = orthographic ? 1 : from.z, wStep = orthographic ? 0 : direction.z;
  Walk column(scale * from.x, scale * direction.x, w, wStep, pixel.x, centre.x);
  Walk row(scale * from.y, scale * direction.y, w, wStep, pixel.y, centre.y);
  double t = 0;
  for (;;) {
    Walk& first = column.next() < row.next() ? column : row;
    const double end = std::clamp(first.next(), t, length);
    const FacetPlane& plane =
        planes_[static_cast<size_t>(row.pixel()) * width_ + static_cast<size_t>(column.pixel())];
    if (plane.offset < 0 && isInside(plane, plane.height(from), glm::dot(plane.normal, direction),
                                     from.z, direction.z, thickness, orthographic, t, end)) {
      return false;
    }
    if (first.next() >= length) return true;
    t = end;
    first.advance();
    if (column.pixel() < 0 || column.pixel() >= width_ || row.pixel() < 0 ||
        row.pixel() >= height_) {
      return true;
    }
  }
}

void DepthField::addOcclusion(std::span<const Hit> hits, double radius, double thickness,
                              uint32_t seed, uint32_t from, uint32_t to,
                              std::span<OcclusionCounts> counts) const {
  forEach(hits.size(), [&](size_t i) {
    const Hit& hit = hits[i];
    if (hit.viewDepth == 0) return;
    Path path{.from = projection_.place(hit.position + kLift * hit.viewDepth * hit.facetNormal),
              .direction = {},
              .length = radius,
              .pixel = hit.pixel};
    countRays(hit, seed, from, to, counts[i], [&](const glm::vec3& direction) {
      path.direction = projection_.turn(direction);
      const double rise = -path.direction.z;
      path.length = rise > 0 ? std::clamp((path.from.z - nearPlane_) / rise, 0.0, radius) : radius;
      return isOpen(path, thickness);
    });
  });
}

}  // namespace grisaille::trace
