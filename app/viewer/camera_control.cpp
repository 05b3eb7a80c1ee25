// SPDX-License-Identifier: MIT
#include "app/viewer/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/base/error.h"

namespace grisaille::app::viewer {
namespace {

constexpr double kPoleMargin = 0.01;  // radians; the least angle between a drag and a pole
// The shortest distance to the target, relative to 1 m plus the length of the coordinates. Below
// 1e-9 their rounding would turn the view. Functions that move the target keep at least this
// distance.
constexpr double kLeastDistance = 1e-6;
// The eye stops at this multiple of the near plane before a surface that it moves to.
constexpr double kClearance = 2;

// Moves the camera to `next` if that is a valid camera.
void take(scene::Camera& camera, const scene::Camera& next) {
  try {
    scene::validate(next);
    camera = next;
  } catch (const Error&) {
    // Out of bounds: the camera stays where it is.
  }
}

double distanceOf(const scene::Camera& camera) {
  return glm::length(camera.target - camera.eye);
}

double leastDistance(const glm::dvec3& place) {
  return kLeastDistance * (1 + glm::length(place));
}

// The axes of a view in this unit direction: right, up, backward.
glm::dmat3 axesOf(scene::Camera camera, const glm::dvec3& direction) {
  camera.eye = glm::dvec3(0);
  camera.target = direction;
  return scene::worldFromView(camera);
}

// Turns a unit direction about the unit axis `up` by `yaw`, and towards `up` by `rise`, radians.
// Stops at kPoleMargin before the poles; a direction inside the margin may stay there.
glm::dvec3 turned(const glm::dvec3& direction, const glm::dvec3& up, double yaw, double rise) {
  const glm::dvec3 level = direction - up * glm::dot(direction, up);
  const double sine = glm::length(level);
  const double angle = std::atan2(sine, glm::dot(direction, up));  // from the upper pole
  const double least = std::min(kPoleMargin, angle);
  const double most = std::max(glm::pi<double>() - kPoleMargin, angle);
  const double next = std::clamp(angle - rise, least, most);
  const glm::dvec3 ahead = level / sine;
  const glm::dvec3 side = glm::cross(up, ahead);
  return std::cos(next) * up + std::sin(next) * (std::cos(yaw) * ahead + std::sin(yaw) * side);
}

}  // namespace

void setTargetDistance(scene::Camera& camera, double metres) {
  scene::Camera next = camera;
  const double distance = std::max(metres, leastDistance(camera.eye));
  next.target = camera.eye + distance * ((camera.target - camera.eye) / distanceOf(camera));
  take(camera, next);
}

void orbit(scene::Camera& camera, const glm::dvec3& pivot, glm::dvec2 dragPixels,
           double heightPixels) {
  const glm::dvec2 angles = dragPixels / heightPixels * glm::pi<double>();
  const double distance = distanceOf(camera);
  const glm::dvec3 outward = (camera.eye - camera.target) / distance;
  const glm::dvec3 next = turned(outward, glm::normalize(camera.up), -angles.x, angles.y);
  // Rows times columns: from the world to the old view, and from the new view to the world.
  const glm::dmat3 turn = axesOf(camera, -next) * glm::transpose(axesOf(camera, -outward));
  scene::Camera moved = camera;
  moved.eye = pivot + turn * (camera.eye - pivot);
  moved.target = moved.eye - std::max(distance, leastDistance(moved.eye)) * next;
  take(camera, moved);
}

bool isOfFingers(glm::dvec2 notches) {
  return notches.x != 0 || 2 * notches.y != std::round(2 * notches.y);
}

void pan(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels) {
  // Metres per pixel at the target's depth.
  const double tall = camera.orthographicHeight > 0
                          ? camera.orthographicHeight
                          : 2 * std::tan(glm::radians(camera.fovyDegrees) / 2) * distanceOf(camera);
  const double metres = tall / heightPixels;
  const glm::dmat3 axes = scene::worldFromView(camera);
  const glm::dvec3 way = metres * (dragPixels.y * axes[1] - dragPixels.x * axes[0]);
  scene::Camera next = camera;
  next.eye += way;
  next.target += way;
  take(camera, next);
}

void zoom(scene::Camera& camera, const glm::dvec3& point, double notches) {
  pinch(camera, point, std::pow(0.9, -notches));
}

void pinch(scene::Camera& camera, const glm::dvec3& point, double scale) {
  const glm::dvec3 way = camera.eye - point;
  const double away = glm::length(way);
  if (!(away > 0)) return;
  const glm::dvec3 forward = (camera.target - camera.eye) / distanceOf(camera);
  const double depth = -glm::dot(way, forward);
  double least = leastDistance(point) / away;
  if (depth > 0) least = std::max(least, kClearance * camera.nearPlane / depth);
  const double factor = std::max(1 / scale, std::min(least, 1.0));
  scene::Camera next = camera;
  next.eye = point + factor * way;
  next.orthographicHeight *= factor;
  next.target = next.eye + std::max(factor * distanceOf(camera), leastDistance(next.eye)) * forward;
  take(camera, next);
}

void focus(scene::Camera& camera, const glm::dvec3& point) {
  scene::Camera next = camera;
  next.target = point;
  const double away = glm::length(point - camera.eye);
  if (away > 2 * kClearance * camera.nearPlane) next.eye = (camera.eye + point) / 2.0;
  take(camera, next);
}

void frameBall(scene::Camera& camera, const glm::dvec3& centre, double radius, double aspect) {
  const double half = std::tan(glm::radians(camera.fovyDegrees) / 2) * std::min(aspect, 1.0);
  const double distance =
      std::max(radius / std::sin(std::atan(half)), radius + kClearance * camera.nearPlane);
  const glm::dvec3 forward = (camera.target - camera.eye) / distanceOf(camera);
  scene::Camera next = camera;
  if (camera.orthographicHeight > 0) next.orthographicHeight = 2 * radius / std::min(aspect, 1.0);
  next.target = centre;
  next.eye = centre - std::max(distance, leastDistance(centre)) * forward;
  take(camera, next);
}

void lookFrom(scene::Camera& camera, const glm::dvec3& from) {
  const glm::dvec3 up = glm::normalize(camera.up);
  const glm::dvec3 outward = (camera.eye - camera.target) / distanceOf(camera);
  glm::dvec3 next = from;
  // From a pole, the margin keeps the present side: the picture does not turn.
  if (std::abs(glm::dot(from, up)) > std::cos(kPoleMargin)) {
    next = turned(outward, up, 0, std::copysign(glm::pi<double>(), glm::dot(from, up)));
  }
  scene::Camera moved = camera;
  moved.eye = camera.target + distanceOf(camera) * next;
  take(camera, moved);
}

void look(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels) {
  const glm::dvec2 angles = dragPixels / heightPixels * (2 * glm::radians(camera.fovyDegrees));
  const glm::dvec3 forward = (camera.target - camera.eye) / distanceOf(camera);
  const double distance = std::max(distanceOf(camera), leastDistance(camera.eye));
  scene::Camera next = camera;
  next.target =
      camera.eye + distance * turned(forward, glm::normalize(camera.up), -angles.x, -angles.y);
  take(camera, next);
}

void fly(scene::Camera& camera, glm::dvec3 axesRightUpForward, double seconds,
         double metresPerSecond) {
  const double length = glm::length(axesRightUpForward);
  if (!(length > 0)) return;
  const glm::dvec3 axes = axesRightUpForward / std::max(length, 1.0);
  const glm::dmat3 view = scene::worldFromView(camera);
  const glm::dvec3 way = seconds * metresPerSecond *
                         (axes.x * view[0] + axes.y * glm::normalize(camera.up) - axes.z * view[2]);
  scene::Camera next = camera;
  next.eye += way;
  const double distance = std::max(distanceOf(camera), leastDistance(next.eye));
  next.target = next.eye - distance * view[2];
  take(camera, next);
}

double flySpeed(double ahead, double extent) {
  constexpr double kLeastShare = 1e-3, kShareASecond = 0.5;
  const double largest = std::isfinite(extent) && extent > 0 ? extent : 1;
  return kShareASecond * std::clamp(ahead, kLeastShare * largest, largest);
}

double steppedSpeed(double factor, double notches) {
  return std::clamp(factor * std::pow(1.25, notches), 1.0 / 64, 64.0);
}

}  // namespace grisaille::app::viewer
