// SPDX-License-Identifier: MIT
#include "lab/oracle/view.h"

#include <utility>

namespace grisaille::lab::oracle {
namespace {

// The first three channels.
glm::dvec3 colourOf(const image::Image& image, const glm::uvec2& at) {
  return {image.at(at.x, at.y, 0), image.at(at.x, at.y, 1), image.at(at.x, at.y, 2)};
}

}  // namespace

View::View(const scene::Camera& camera, const glm::uvec2& size, uint32_t guard,
           Attachments attachments)
    : size_(size),
      guard_(static_cast<int>(guard)),
      // Single precision, same as the shaders: rounding must not cut a surface on the near plane.
      nearPlane_(static_cast<float>(camera.nearPlane)),
      camera_(scene::viewOf(camera, size)),
      viewFromWorld_(glm::transpose(camera_.worldFromView)),
      attachments_(std::move(attachments)) {}

bool View::holds(const glm::ivec2& pixel) const {
  const glm::ivec2 low(-guard_), high = size_ + guard_;
  return pixel.x >= low.x && pixel.y >= low.y && pixel.x < high.x && pixel.y < high.y;
}

glm::ivec2 View::nearest(const glm::ivec2& pixel) const {
  return glm::clamp(pixel + guard_, glm::ivec2(0), size_ + 2 * guard_ - 1);
}

double View::depth(const glm::ivec2& pixel) const {
  const glm::uvec2 at(nearest(pixel));
  return attachments_.depth.at(at.x, at.y);
}

double View::thickness(const glm::ivec2& pixel) const {
  if (attachments_.thickness.pixels.empty()) return -1;
  const glm::ivec2 at = nearest(pixel);
  return attachments_.thickness.at(at.x, at.y);
}

double View::back(const glm::ivec2& pixel) const {
  const glm::uvec2 at(nearest(pixel));
  return attachments_.back.at(at.x, at.y);
}

double View::next(const glm::ivec2& pixel) const {
  const glm::uvec2 at(nearest(pixel));
  return attachments_.next.at(at.x, at.y);
}

glm::dvec3 View::colour(const glm::ivec2& pixel) const {
  return colourOf(attachments_.colour, glm::uvec2(nearest(pixel)));
}

glm::dvec3 View::worldNormal(const glm::ivec2& pixel) const {
  return colourOf(attachments_.normal, glm::uvec2(nearest(pixel)));
}

glm::dvec3 View::normal(const glm::ivec2& pixel) const {
  const glm::dvec3 world = worldNormal(pixel);
  return glm::dot(world, world) < 0.25 ? glm::dvec3(0, 0, 1) : viewFromWorld_ * world;
}

glm::dvec3 View::ray(const glm::dvec2& point) const {
  if (orthographic()) return {0, 0, -1};
  return {point * camera_.scale + camera_.offset, -1};
}

glm::dvec3 View::position(const glm::ivec2& pixel, double depth) const {
  return scene::viewPosition(camera_, glm::dvec2(pixel) + 0.5, depth);
}

glm::dmat3 axesAbout(const glm::dvec3& n) {
  const double s = n.z >= 0 ? 1 : -1;
  const double a = -1 / (s + n.z);
  const double b = n.x * n.y * a;
  return {glm::dvec3(1 + s * n.x * n.x * a, s * b, -s * n.x),
          glm::dvec3(b, s + n.y * n.y * a, -n.y), n};
}

}  // namespace grisaille::lab::oracle
