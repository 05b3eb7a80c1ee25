// SPDX-License-Identifier: MIT
// A viewer with the built-in atrium: the surfaces that its cameras see, found by rays here.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "app/services/scene_services.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {

using scene::Camera;

class NavigationTest : public WindowTest {
 protected:
  // A picture with room for the axes.
  std::vector<std::string> wide(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"--backend", GetParam(),        "--size", "940x720",
                                    "--effects", "ssao,sspm",       "--set",  "ssao.kernel_size=2",
                                    "--set",     "ssao.blur_size=0"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static Camera cameraOf(const DrivenViewer& viewer) {
    return scene::parseCamera(viewer.value("camera"), "viewer");
  }
  // Size and corner of the picture.
  static glm::ivec4 rectOf(const DrivenViewer& viewer) {
    const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<int>>();
    return {rect[0], rect[1], rect[2] - rect[0], rect[3] - rect[1]};
  }
  // The surface point that a camera sees at a pixel of the window.
  std::optional<glm::dvec3> seen(const DrivenViewer& viewer, const Camera& camera, Point at) {
    const glm::ivec4 rect = rectOf(viewer);
    const glm::dvec3 towards =
        glm::normalize(scene::rayAt(scene::viewOf(camera, {rect[2], rect[3]}),
                                    {at.x - rect[0] + 0.5, at.y - rect[1] + 0.5})
                           .direction);
    const glm::vec3 unit(towards);
    const grisaille_ray ray = {.origin = {camera.eye.x, camera.eye.y, camera.eye.z},
                               .direction = {unit.x, unit.y, unit.z},
                               .reach = INFINITY};
    grisaille_hit hit = {};
    rays_.cast(std::span(&ray, 1), std::span(&hit, 1));
    if (hit.kind != GRISAILLE_HIT_SURFACE) return std::nullopt;
    return camera.eye + double{hit.distance} * towards;
  }
  // The pixel of the window at which a camera sees a point.
  static glm::dvec2 pixelOf(const DrivenViewer& viewer, const Camera& camera,
                            const glm::dvec3& point) {
    const glm::ivec4 rect = rectOf(viewer);
    const glm::dvec3 view = glm::transpose(scene::worldFromView(camera)) * (point - camera.eye);
    const glm::dvec2 pixel = scene::pixelOf(scene::viewOf(camera, {rect[2], rect[3]}), view);
    return glm::dvec2(rect[0], rect[1]) + pixel - 0.5;
  }
  static void expectAt(const DrivenViewer& viewer, const Camera& camera, const glm::dvec3& point,
                       Point at) {
    const glm::dvec2 pixel = pixelOf(viewer, camera, point);
    EXPECT_LT(glm::length(pixel - glm::dvec2(at.x, at.y)), 1.5)
        << pixel.x << ", " << pixel.y << " instead of " << at.x << ", " << at.y;
  }
  // Turns the wheel over a point; `button`: xdotool's number of a direction.
  static Camera turnWheel(DrivenViewer& viewer, Point at, int button, int notches,
                          const std::string& held = "") {
    const std::string before = viewer.value("camera");
    viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) +
                (held.empty() ? "" : " keydown " + held) + " click --repeat " +
                std::to_string(notches) + " " + std::to_string(button) +
                (held.empty() ? "" : " keyup " + held));
    viewer.untilChanged("camera", before);
    return cameraOf(viewer);
  }

  scene::Scene atrium_ = scene::makeAtrium();
  app::SceneRays rays_{atrium_};
};

}  // namespace grisaille::tests
