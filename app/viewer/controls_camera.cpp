// SPDX-License-Identifier: MIT
// How the pointer and the keys move the camera: about the surfaces that the user sees.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "app/viewer/axis_widget.h"
#include "app/viewer/camera_control.h"
#include "app/viewer/controls.h"
#include "app/viewer/input.h"
#include "core/scene/view.h"

namespace grisaille::app::viewer {
namespace {

constexpr double kArrowStep = 24;   // pixels; an arrow key acts like this drag
constexpr double kPanStep = 32;     // pixels; a notch of the wheel pans by this drag
constexpr int kHalvings = 4;        // of a step of the orbit that a surface stops
constexpr double kObjectRadii = 4;  // radius shown around an object, suitable radii
constexpr float kAxesShare = 4;     // least size of a picture with axes, their sizes

}  // namespace

void Controls::dragCamera(const Place& place, glm::dvec2 moved) {
  scene::Camera& camera = session_.camera;
  const double height = place.size.y;
  if (drag_ == Drag::kLook) return look(camera, moved, height);
  // Not at the press: a click alone leaves the camera as it is.
  if (!std::exchange(aimed_, true)) aim(pressed_);
  if (drag_ == Drag::kPan) return pan(camera, moved, height);
  orbitClear(pressed_.surface ? pressed_.point : camera.target, moved, height);
}

// Orbits as far as no surface is in the eye's way: else only to the side, or only up and down, or a
// part of the way. With Shift, through surfaces.
void Controls::orbitClear(const glm::dvec3& pivot, glm::dvec2 moved, double height) {
  const scene::Camera before = session_.camera;
  const bool through = ImGui::GetIO().KeyShift;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double share = std::ldexp(1.0, -halving);
    for (const glm::dvec2 part : {glm::dvec2(1, 1), glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
      scene::Camera next = before;
      orbit(next, pivot, share * part * moved, height);
      if (!through && !session_.isFree(before.eye, next.eye, 2 * before.nearPlane)) continue;
      session_.camera = next;
      return;
    }
  }
}

Controls::Pick Controls::pick(const Place& place, glm::dvec2 at) {
  const scene::Camera& camera = session_.camera;
  if (stage_ != nullptr && stage_->camera() != nullptr && stage_->size() == place.size) {
    const glm::ivec2 texel(glm::floor(at));
    std::vector<double> depths;
    session_.attempt("pick", [&] { depths = stage_->depthsAt(std::span(&texel, 1)); });
    if (!depths.empty() && std::isfinite(depths[0])) {
      const scene::Camera& seen = *stage_->camera();
      return {scene::worldPosition(scene::viewOf(seen, place.size), at, depths[0]), true};
    }
  }
  const double distance = glm::length(camera.target - camera.eye);
  return {scene::worldPosition(scene::viewOf(camera, place.size), at, distance), false};
}

// The least distance of what is in the middle fifth of the picture, metres; infinite: sky.
double Controls::distanceAhead(const Place& place) {
  if (stage_ == nullptr || stage_->camera() == nullptr || stage_->size() != place.size) {
    return glm::length(session_.camera.target - session_.camera.eye);
  }
  std::vector<glm::ivec2> texels;
  for (const double y : {-0.1, 0.0, 0.1}) {
    for (const double x : {-0.1, 0.0, 0.1}) {
      texels.emplace_back((0.5 + glm::dvec2(x, y)) * glm::dvec2(place.size));
    }
  }
  double nearest = std::numeric_limits<double>::infinity();
  session_.attempt("pick", [&] {
    for (const double depth : stage_->depthsAt(texels)) nearest = std::min(nearest, depth);
  });
  return nearest;
}

void Controls::scroll(const Place& place) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 notches(io.MouseWheelH, io.MouseWheel);
  const bool fingers = fingers_.scrolled;
  if (io.KeyCtrl) return magnify(place, std::pow(1.25, notches.y));
  if (drag_ == Drag::kLook) {
    session_.speed = steppedSpeed(session_.speed, notches.y);
    return;
  }
  const glm::dvec2 at = pointAt(place, cursor_);
  scene::Camera& camera = session_.camera;
  if (!fingers && !io.KeyShift) return zoom(camera, pick(place, at).point, notches.y);
  // The surface where a burst began follows it, not those that come under the pointer.
  if (sincePan_ > kRest) aim(pick(place, at));
  pans_ = true;
  sincePan_ = 0;
  const bool sideways = io.KeyShift && notches.x == 0 && !fingers;
  pan(camera, kPanStep * (sideways ? glm::dvec2(0, notches.y) : notches), place.size.y);
}

void Controls::pinch(const Place& place) {
  if (ImGui::GetIO().KeyCtrl) return magnify(place, fingers_.scale);
  const Pick under = pick(place, pointAt(place, cursor_));
  viewer::pinch(session_.camera, under.point, fingers_.scale);
}

// Gives the target the depth of a surface. Without one, it keeps its own.
void Controls::aim(const Pick& at) {
  scene::Camera& camera = session_.camera;
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  if (at.surface) setTargetDistance(camera, glm::dot(at.point - camera.eye, forward));
}

// Arrows and page keys: the same as drags and the wheel, at the surface in the middle.
void Controls::steer(const Place& place) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](int plus, int minus) {
    return (isKeyPressed(plus, true) ? 1.0 : 0.0) - (isKeyPressed(minus, true) ? 1.0 : 0.0);
  };
  const glm::dvec2 arrows(pressed(GLFW_KEY_RIGHT, GLFW_KEY_LEFT),
                          pressed(GLFW_KEY_DOWN, GLFW_KEY_UP));
  const double notches = pressed(GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN);
  const bool moves = arrows != glm::dvec2(0) && !io.KeyAlt;  // with Alt: the camera's undo
  if (!moves && notches == 0) return;
  const Pick middle = pick(place, 0.5 * glm::dvec2(place.size));
  if (notches != 0) zoom(session_.camera, middle.point, notches);
  if (!moves) return;
  if (io.KeyShift) {
    aim(middle);
    pan(session_.camera, kArrowStep * arrows, place.size.y);
  } else {
    session_.findSurfaces();
    orbitClear(middle.surface ? middle.point : session_.camera.target, kArrowStep * arrows,
               place.size.y);
  }
}

void Controls::magnify(const Place& place, double factor) {
  const glm::dvec2 point = pointAt(place, cursor_);
  session_.zoom = std::clamp(session_.zoom * static_cast<float>(factor), 1.0f, 64.0f);
  const glm::dvec2 size(place.size);
  const glm::dvec2 centre = point - (cursor_ - glm::dvec2(place.corner) + 0.5 - 0.5 * size) /
                                        static_cast<double>(session_.zoom);
  session_.centre = glm::clamp(glm::vec2(centre / size), 0.0f, 1.0f);
  if (session_.zoom == 1) session_.centre = glm::vec2(0.5f);
}

bool Controls::updateFlight(const Place& place, double seconds) {
  const auto axis = [](int plus, int minus) {
    return (isKeyDown(plus) ? 1.0 : 0.0) - (isKeyDown(minus) ? 1.0 : 0.0);
  };
  const glm::dvec3 axes(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                        axis(GLFW_KEY_W, GLFW_KEY_S));
  if (axes == glm::dvec3(0)) return false;
  const double speed = session_.speed * flySpeed(distanceAhead(place), session_.extent);
  panel_.layout.note("flying speed", 0, 0, 0, 0, fmt::format("{:.6g}", speed));
  fly(session_.camera, axes, std::min(seconds, 0.1), speed * (ImGui::GetIO().KeyShift ? 4 : 1));
  return true;
}

// The selected object, unless it is framed already, else the scene.
void Controls::frameScene(const Place& place) {
  if (!session_.scene || place.size.y == 0) return;
  const double aspect = double{1} * place.size.x / place.size.y;
  scene::Camera next = session_.camera;
  const auto selected = session_.chosenPoint();
  if (selected && next.target != *selected) {
    frameBall(next, *selected, kObjectRadii * session_.sceneRadius(), aspect);
  } else {
    const scene::Bounds& bounds = session_.scene->bounds;
    frameBall(next, (bounds.min + bounds.max) / 2.0,
              std::max(glm::length(bounds.max - bounds.min) / 2, next.nearPlane), aspect);
  }
  session_.goTo(next);
}

// Small pictures have no room for the axes.
void Controls::drawAxes(const Place& place, float pixelsAUnit) {
  const glm::vec2 size = glm::vec2(place.size) / pixelsAUnit;
  if (std::min(size.x, size.y) < kAxesShare * axisWidgetSize()) return;
  const float gap = ImGui::GetStyle().WindowPadding.x;
  const glm::vec2 corner = glm::vec2(place.corner) / pixelsAUnit + glm::vec2(size.x - gap, gap);
  const auto from = drawAxisWidget(session_.camera, corner, panel_.layout);
  if (!from) return;
  scene::Camera next = session_.camera;
  lookFrom(next, *from);
  session_.goTo(next);
}

}  // namespace grisaille::app::viewer
