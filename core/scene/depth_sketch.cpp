// SPDX-License-Identifier: MIT
#include "core/scene/depth_sketch.h"

#include <algorithm>
#include <cmath>

namespace grisaille::scene {

DepthSketch::DepthSketch(const Camera& camera, uint32_t width, uint32_t height)
    : viewFromWorld_(glm::transpose(worldFromView(camera))),
      eye_(camera.eye),
      near_(camera.nearPlane),
      width_(width),
      height_(height),
      inverse_(size_t{width} * height, 0.0),
      undrawn_(inverse_.size(), 0.0),
      owner_(inverse_.size(), 0) {
  slope_.y = std::tan(glm::radians(camera.fovyDegrees) / 2);
  slope_.x = slope_.y * width / height;
}

void DepthSketch::draw(const Face& face) {
  ++drawn_;
  std::array<glm::dvec3, 3> view;
  for (size_t i = 0; i < 3; ++i) view[i] = viewFromWorld_ * (face.corners[i] - eye_);
  // Clipping at the near plane leaves at most four corners.
  std::array<Corner, 4> corners{};
  size_t count = 0;
  const auto add = [&](const glm::dvec3& p) {
    corners[count++] = {.x = (p.x / (-p.z * slope_.x) + 1) / 2 * width_,
                        .y = (1 - p.y / (-p.z * slope_.y)) / 2 * height_,
                        .inverse = -1 / p.z};
  };
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &from = view[i], &to = view[(i + 1) % 3];
    const double a = -from.z - near_, b = -to.z - near_;
    if (a >= 0) add(from);
    if ((a >= 0) != (b >= 0)) {
      glm::dvec3 cut = from + (to - from) * (a / (a - b));
      cut.z = -near_;
      add(cut);
    }
  }
  if (count < 3) return;
  // y points down, so that the front of a triangle has a negative area.
  double area = 0;
  for (size_t i = 1; i + 1 < count; ++i) {
    area += (corners[i].x - corners[0].x) * (corners[i + 1].y - corners[0].y) -
            (corners[i + 1].x - corners[0].x) * (corners[i].y - corners[0].y);
  }
  const bool isDrawn = area < 0 || face.bothSides;
  std::vector<double>& nearest = isDrawn ? inverse_ : undrawn_;
  const auto set = [&](size_t pixel, double inverse) {
    if (inverse <= nearest[pixel]) return;
    nearest[pixel] = inverse;
    if (isDrawn) owner_[pixel] = drawn_;
  };
  for (size_t i = 1; i + 1 < count; ++i) {
    if (area < 0) {
      fill(corners[0], corners[i + 1], corners[i], set);
    } else {
      fill(corners[0], corners[i], corners[i + 1], set);
    }
  }
}

template <typename Use>
void DepthSketch::fill(const Corner& a, const Corner& b, const Corner& c, Use&& use) const {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(area > 0)) return;
  // The first and the last pixel whose centre lies in the range.
  const auto range = [](double low, double high, uint32_t size) {
    const double most = size;
    return std::pair(static_cast<uint32_t>(std::clamp(std::ceil(low - 0.5), 0.0, most)),
                     static_cast<uint32_t>(std::clamp(std::floor(high + 0.5), 0.0, most)));
  };
  const auto [left, right] = range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), width_);
  const auto [top, bottom] = range(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), height_);
  for (uint32_t y = top; y < bottom; ++y) {
    for (uint32_t x = left; x < right; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double u = (c.x - b.x) * (py - b.y) - (px - b.x) * (c.y - b.y);
      const double v = (a.x - c.x) * (py - c.y) - (px - c.x) * (a.y - c.y);
      const double w = area - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      use(size_t{y} * width_ + x, (u * a.inverse + v * b.inverse + w * c.inverse) / area);
    }
  }
}

image::Image DepthSketch::depth() const {
  image::Image image{.width = width_, .height = height_, .channels = 1, .pixels = {}};
  for (const double inverse : inverse_) {
    image.pixels.push_back(inverse > 0 ? static_cast<float>(1 / inverse) : 0.0f);
  }
  return image;
}

double DepthSketch::covered(double least) const {
  const auto count = std::ranges::count_if(
      inverse_, [&](double inverse) { return inverse > 0 && inverse * least <= 1; });
  return static_cast<double>(count) / static_cast<double>(inverse_.size());
}

double DepthSketch::throughBacks() const {
  size_t count = 0;
  for (size_t i = 0; i < inverse_.size(); ++i) count += undrawn_[i] > inverse_[i];
  return static_cast<double>(count) / static_cast<double>(inverse_.size());
}

size_t DepthSketch::visibleFaces() const {
  std::vector<bool> seen(size_t{drawn_} + 1);
  for (const uint32_t owner : owner_) seen[owner] = true;
  return static_cast<size_t>(std::count(seen.begin() + 1, seen.end(), true));
}

image::Image sketchDepth(const Scene& scene, const Camera& camera, uint32_t width,
                         uint32_t height) {
  // The faces' coordinates are relative to the eye, so that they lose no precision far from the
  // origin.
  Camera near = camera;
  near.eye = glm::dvec3(0);
  near.target = camera.target - camera.eye;
  DepthSketch sketch(near, width, height);
  forEachFace(scene, camera.eye, [&](const Face& face) { sketch.draw(face); });
  return sketch.depth();
}

}  // namespace grisaille::scene
