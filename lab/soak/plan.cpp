// SPDX-License-Identifier: MIT
#include "lab/soak/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

namespace grisaille::lab::soak {
namespace {

constexpr double kUndoEvery = 6, kLoadEvery = 60, kReloadEvery = 200, kResizeEvery = 15;  // seconds
constexpr double kRedoAfter = 0.5, kLoadAfter = 5;
constexpr double kTurn = 40;  // seconds of a full turn of the camera

}  // namespace

std::vector<glm::uvec2> sizesOf(const Plan& plan) {
  return {plan.size, glm::max(3u * plan.size / 4u, 1u), glm::max(plan.size / 2u, 1u)};
}

std::vector<Due> schedule(const Plan& plan) {
  const double end = 60 * plan.minutes;
  std::mt19937 random(plan.seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Due> all;
  // One in each of `count` equal parts of the time, so that chance leaves no long gap.
  const auto spread = [&](double every, const auto& add) {
    const int count = std::max(2, static_cast<int>(end / every));
    for (int i = 0; i < count; ++i) add(end * (i + share(random)) / count);
  };
  bool again = false;
  spread(kUndoEvery, [&](double second) {
    again = !again;
    all.push_back({second, Event::kUndo, 1 + static_cast<uint32_t>(random() % 100), again});
    if (again) all.push_back({second + kRedoAfter, Event::kRedo});
  });
  spread(kLoadEvery, [&](double second) {
    all.push_back({second, Event::kLoadObjects});
    all.push_back({std::max(0.0, second - kLoadAfter), Event::kSaveObjects});
  });
  spread(kReloadEvery, [&](double second) { all.push_back({second, Event::kReloadEffects}); });
  const auto sizes = static_cast<uint32_t>(sizesOf(plan).size());
  uint32_t size = 0;
  spread(kResizeEvery, [&](double second) {
    size = (size + 1 + static_cast<uint32_t>(random() % (sizes - 1))) % sizes;  // another one
    all.push_back({second, Event::kResize, size});
  });
  std::ranges::stable_sort(all, {}, &Due::second);
  return all;
}

scene::Camera cameraAt(const scene::Camera& start, double second, double reach) {
  scene::Camera camera = start;
  const glm::dmat3 axes = scene::worldFromView(start);
  const auto wave = [&](double period) {
    return std::sin(glm::two_pi<double>() * second / period);
  };
  camera.eye +=
      reach / 2 * (axes[0] * wave(31) + axes[2] * wave(47)) + reach / 4 * axes[1] * wave(19);
  const double turn = glm::two_pi<double>() * second / kTurn;
  const double distance = glm::length(start.target - start.eye);
  camera.target = camera.eye + distance * (std::sin(turn) * axes[0] - std::cos(turn) * axes[2] +
                                           0.2 * wave(23) * axes[1]);
  return camera;
}

}  // namespace grisaille::lab::soak
