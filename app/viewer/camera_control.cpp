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

void orbit(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels) {
  const glm::dvec2 angles = dragPixels / heightPixels * glm::pi<double>();
  const double distance = distanceOf(camera);
  const glm::dvec3 outward = (camera.eye - camera.target) / distance;
  scene::Camera next = camera;
  next.eye =
      camera.target + distance * turned(outward, glm::normalize(camera.up), -angles.x, angles.y);
  take(camera, next);
}

void pan(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels) {
  // Metres per pixel at the target's depth.
  const double metres =
      2 * std::tan(glm::radians(camera.fovyDegrees) / 2) * distanceOf(camera) / heightPixels;
  const glm::dmat3 axes = scene::worldFromView(camera);
  const glm::dvec3 way = metres * (dragPixels.y * axes[1] - dragPixels.x * axes[0]);
  scene::Camera next = camera;
  next.eye += way;
  next.target += way;
  take(camera, next);
}

void dolly(scene::Camera& camera, double notches) {
  const double distance = distanceOf(camera);
  const double least = std::min(leastDistance(camera.target), distance);
  const glm::dvec3 outward = (camera.eye - camera.target) / distance;
  scene::Camera next = camera;
  next.eye = camera.target + std::max(distance * std::pow(0.9, notches), least) * outward;
  take(camera, next);
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

double flySpeed(const scene::Bounds& bounds) {
  const double speed = glm::length(bounds.max - bounds.min) / 10;
  return std::isfinite(speed) && speed > 0 ? steppedSpeed(speed, 0) : 1;
}

double steppedSpeed(double metresPerSecond, double notches) {
  return std::clamp(metresPerSecond * std::pow(1.25, notches), 1e-4, 1e6);
}

}  // namespace grisaille::app::viewer
