// SPDX-License-Identifier: MIT
#include "core/frame/depth_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace grisaille::frame {
namespace {

// A facet seen at such a slant that its inverse depth changes by this share from a pixel to the
// next has its pixel's depth alone: its normal, rounded to 11 bits, says nothing that far along it.
constexpr double kSteepest = 0.5;
// Inverse depths that differ by less than this share are of one surface: what curved ones, and
// normals of 11 bits, make of a pixel's width. Nearer than that to a surface, a ray's origin may
// lie on either side of it.
constexpr double kSame = 3e-4;
// A ray whose picture is shorter comes from the eye, as far as pixels tell. Pixels.
constexpr double kPoint = 1.0 / 16;

// Pixels, and inverse view depth.
glm::dvec3 pictured(const glm::dvec3& view, double focal, const glm::dvec2& size) {
  const double w = -view.z;
  return {0.5 * size.x + focal * view.x / w, 0.5 * size.y - focal * view.y / w, 1 / w};
}

// One of each two neighbours, so that each pair comes up once.
constexpr glm::ivec2 kHalfAround[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

bool isInside(const glm::dvec2& place, const glm::dvec2& size) {
  return place.x >= 0 && place.y >= 0 && place.x < size.x && place.y < size.y;
}

}  // namespace

// The part of a ray that the picture may show, as a straight line over the picture.
struct DepthRays::Path {
  glm::dvec3 start, end;        // pixels, inverse view depth
  double startRatio, endRatio;  // metres along the ray, times the inverse view depth there
  uint32_t atEnd;               // the answer where all of it lies in sight

  glm::dvec3 at(double share) const { return start + share * (end - start); }
  double metresAt(double share) const {
    return (startRatio + share * (endRatio - startRatio)) / at(share).z;
  }
};

DepthRays::DepthRays(const image::Image& depth, const image::Image& facetNormal,
                     const scene::Camera& camera)
    : size_(depth.width, depth.height), near_(camera.nearPlane), eye_(camera.eye) {
  if (depth.width != facetNormal.width || depth.height != facetNormal.height ||
      depth.channels < 1 || facetNormal.channels < 3) {
    throw Error(ErrorId::kImageMismatch, "depth of {}x{}, {} channels, facet normals of {}x{}, {}",
                depth.width, depth.height, depth.channels, facetNormal.width, facetNormal.height,
                facetNormal.channels);
  }
  scene::validate(camera);
  focal_ = size_.y / 2 / std::tan(glm::radians(camera.fovyDegrees) / 2);
  viewFromWorld_ = glm::transpose(scene::worldFromView(camera));
  facets_.resize(size_t{depth.width} * depth.height);
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      const double metres = depth.at(x, y);
      if (metres == 0) continue;
      Facet& facet = facets_[size_t{y} * depth.width + x];
      constexpr float kNearest = std::numeric_limits<float>::max();
      if (!(metres > 1 / kNearest)) {
        // No depth at all: every ray is behind it.
        facet.depth = kNearest;
        continue;
      }
      facet.depth = static_cast<float>(1 / metres);
      facet.normal = {facetNormal.at(x, y, 0), facetNormal.at(x, y, 1), facetNormal.at(x, y, 2)};
      // On the plane n . p = m, with p = w (a, b, -1): 1 / w = n . (a, b, -1) / m.
      const glm::dvec3 n = viewFromWorld_ * glm::dvec3(facet.normal);
      const glm::dvec3 sight((x + 0.5 - 0.5 * size_.x) / focal_, (0.5 * size_.y - y - 0.5) / focal_,
                             -1);
      const glm::dvec2 slope = glm::dvec2(n.x, -n.y) / (focal_ * glm::dot(n, sight));
      if (std::abs(slope.x) + std::abs(slope.y) < kSteepest) facet.slope = slope / metres;
    }
  }
  findEdges();
}

void DepthRays::findEdges() {
  const glm::ivec2 size(size_);
  for (glm::ivec2 pixel(0); pixel.y < size.y; ++pixel.y) {
    for (pixel.x = 0; pixel.x < size.x; ++pixel.x) {
      for (const glm::ivec2& step : kHalfAround) {
        const glm::ivec2 other = pixel + step;
        if (!inPicture(other) || goesOn(pixel, other)) continue;
        facets_[indexOf(pixel)].edge = true;
        facets_[indexOf(other)].edge = true;
      }
    }
  }
}

void DepthRays::cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) {
  for (size_t i = 0; i < rays.size(); ++i) hits[i] = cast(rays[i]);
}

grisaille_hit DepthRays::cast(const grisaille_ray& ray) const {
  Path path;
  uint32_t answer = GRISAILLE_HIT_UNKNOWN;
  if (lay(ray, path, answer)) return follow(ray, path);
  grisaille_hit hit = {};
  hit.kind = answer;
  return hit;
}

// False where the answer is clear without the picture.
bool DepthRays::lay(const grisaille_ray& ray, Path& path, uint32_t& answer) const {
  const glm::dvec3 from =
      viewFromWorld_ * (glm::dvec3(ray.origin[0], ray.origin[1], ray.origin[2]) - eye_);
  const glm::dvec3 along =
      viewFromWorld_ *
      glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2]));
  const double away = -along.z;  // view depth that a metre gains
  double first = 0, last = ray.reach;
  path.atEnd = GRISAILLE_HIT_NONE;

  if (-from.z < near_) {
    if (glm::length(from) > near_) return false;
    const glm::dvec3 end = from + last * along;
    if (std::isfinite(last) && glm::length(end) <= near_) {
      answer = GRISAILLE_HIT_NONE;
      return false;
    }
    if (away <= 0) return false;
    first = (near_ + from.z) / away;
    if (first >= last) {
      if (end.z < 0 && isInside(glm::dvec2(pictured(end, focal_, size_)), size_)) {
        answer = GRISAILLE_HIT_NONE;
      }
      return false;
    }
  } else if (away < 0) {
    const double leave = (-from.z - near_) / -away;
    if (leave < last) {
      last = leave;
      const bool stays =
          std::isfinite(ray.reach) && glm::length(from + double{ray.reach} * along) <= near_;
      if (!stays) path.atEnd = GRISAILLE_HIT_UNKNOWN;
    }
  } else if (away == 0 && std::isinf(last)) {
    last = 2 * (size_.x + size_.y) / focal_ * -from.z;  // out of the picture
  }

  path.start = pictured(from + first * along, focal_, size_);
  path.startRatio = first * path.start.z;
  if (!isInside(glm::dvec2(path.start), size_)) return false;
  if (std::isinf(last)) {
    path.end = pictured(along, focal_, size_);
    path.end.z = 0;
    path.endRatio = 1 / away;
  } else {
    path.end = pictured(from + last * along, focal_, size_);
    path.endRatio = last * path.end.z;
  }
  return true;
}

bool DepthRays::inPicture(const glm::ivec2& pixel) const {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < static_cast<int>(size_.x) &&
         pixel.y < static_cast<int>(size_.y);
}

size_t DepthRays::indexOf(const glm::ivec2& pixel) const {
  return static_cast<size_t>(pixel.y) * static_cast<size_t>(size_.x) + static_cast<size_t>(pixel.x);
}

// Inverse depth of the plane that a pixel shows, there or beside it.
double DepthRays::shownAt(const glm::ivec2& pixel, const glm::dvec2& place) const {
  const Facet& facet = facets_[indexOf(pixel)];
  const glm::dvec2 aside = place - (glm::dvec2(pixel) + 0.5);
  return facet.depth + double{facet.slope.x} * aside.x + double{facet.slope.y} * aside.y;
}

// Whether the surface of one pixel goes on into the one beside it.
bool DepthRays::goesOn(const glm::ivec2& pixel, const glm::ivec2& other) const {
  const glm::dvec2 between = 0.5 * glm::dvec2(pixel + other) + 0.5;
  const double one = shownAt(pixel, between), two = shownAt(other, between);
  return std::abs(one - two) <= kSame * std::max(std::abs(one), std::abs(two));
}

// Whether another surface beside a pixel makes it doubtful what a ray that comes by there meets. Up
// to `leave` the pixel has the ray before its facet, and there `hits` it.
bool DepthRays::contested(const Path& path, const glm::ivec2& pixel, double enter, double leave,
                          bool hits) const {
  const glm::dvec3 first = path.at(enter), last = path.at(leave);
  const glm::dvec2 centre = glm::dvec2(pixel) + 0.5;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const glm::ivec2 other = pixel + glm::ivec2(x, y);
      // Of the nine, the ones on the ray's side of the pixel's centre.
      const glm::dvec2 side(x, y);
      const glm::dvec2 near = side * (glm::dvec2(first) - centre);
      const glm::dvec2 far = side * (glm::dvec2(last) - centre);
      const glm::dvec2 reach = glm::max(near, far);
      if ((x != 0 && reach.x <= 0) || (y != 0 && reach.y <= 0)) continue;
      if (!inPicture(other) || goesOn(pixel, other)) continue;
      const double lead = last.z - shownAt(other, glm::dvec2(last));
      if (lead < 0 || first.z < shownAt(other, glm::dvec2(first))) return true;
      if (hits && lead > kSame * last.z) return true;
    }
  }
  return false;
}

// Pixel by pixel, as Amanatides and Woo (1987, "A Fast Voxel Traversal Algorithm for Ray Tracing").
grisaille_hit DepthRays::follow(const grisaille_ray& ray, const Path& path) const {
  const glm::dvec2 way(path.end - path.start);
  const glm::ivec2 step(way.x < 0 ? -1 : 1, way.y < 0 ? -1 : 1);
  const bool point = glm::length(way) < kPoint;
  grisaille_hit unknown = {};
  unknown.kind = GRISAILLE_HIT_UNKNOWN;
  glm::ivec2 pixel(glm::floor(glm::dvec2(path.start)));
  double enter = 0;
  const double room = path.start.z - shownAt(pixel, glm::dvec2(path.start));
  if (room < kSame * path.start.z) return unknown;
  for (;;) {
    glm::dvec2 borders(std::numeric_limits<double>::infinity());
    for (int axis = 0; axis < 2; ++axis) {
      const double border = pixel[axis] + (step[axis] > 0 ? 1 : 0);
      if (way[axis] != 0) borders[axis] = (border - path.start[axis]) / way[axis];
    }
    const int axis = borders.x < borders.y ? 0 : 1;
    const double leave = std::clamp(borders[axis], enter, 1.0);
    const glm::dvec3 from = path.at(enter), to = path.at(leave);
    const double first = from.z - shownAt(pixel, glm::dvec2(from));
    const double second = to.z - shownAt(pixel, glm::dvec2(to));
    const bool hits = second < 0;
    const double until = hits ? enter + first / (first - second) * (leave - enter) : leave;
    const bool doubtful = facets_[indexOf(pixel)].edge && !point;
    if (first < 0 || (doubtful && contested(path, pixel, enter, until, hits))) return unknown;
    if (hits) return hitAt(ray, path, facets_[indexOf(pixel)], until);
    if (leave >= 1) break;
    const glm::ivec2 left = pixel;
    pixel[axis] += step[axis];
    if (!inPicture(pixel)) return unknown;
    enter = leave;
    // One surface's planes do not quite meet.
    const bool slips = to.z < shownAt(pixel, glm::dvec2(to)) && goesOn(left, pixel);
    if (slips) return hitAt(ray, path, facets_[indexOf(pixel)], enter);
  }
  grisaille_hit end = {};
  end.kind = path.atEnd;
  return end;
}

grisaille_hit DepthRays::hitAt(const grisaille_ray& ray, const Path& path, const Facet& facet,
                               double share) const {
  const glm::vec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
  const float length = glm::length(facet.normal);
  glm::vec3 normal = std::abs(length - 1) < 0.1f ? facet.normal / length : -direction;
  if (glm::dot(normal, direction) > 0) normal = -normal;
  return {.kind = GRISAILLE_HIT_SURFACE,
          .distance = static_cast<float>(path.metresAt(share)),
          .normal = {normal.x, normal.y, normal.z}};
}

}  // namespace grisaille::frame
