// SPDX-License-Identifier: MIT
// What a soak does and when: shots under a moving camera, with undo, reload and resize at random.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "core/scene/camera.h"

namespace grisaille::lab::soak {

struct Plan {
  double minutes = 10;    // over 0
  size_t before = 5000;   // shots that are in their places when it begins
  size_t shots = 20'000;  // fired at an even rate over that time
  uint32_t memory = 32;   // limit of the effect, MB
  uint32_t seed = 1;
  glm::uvec2 size = {640, 360};  // of the largest picture, pixels
};

enum class Event : uint8_t { kUndo, kRedo, kSaveObjects, kLoadObjects, kReloadEffects, kResize };

struct Due {
  double second;  // since the start
  Event event;
  uint32_t amount = 0;  // kUndo: shots, 1 to 100; kResize: index of sizesOf()
  bool again = false;   // kUndo: a kRedo follows, before which no shot is fired
};

// The events in the order of their time; the same for the same plan. Each kind happens at least
// twice. Objects are saved a while before they are loaded again. Every other undo is redone.
std::vector<Due> schedule(const Plan& plan);

// The sizes of the pictures: the plan's, three quarters of it, and half of it.
std::vector<glm::uvec2> sizesOf(const Plan& plan);

// The camera turns around and wanders about its eye, at most `reach` metres off.
scene::Camera cameraAt(const scene::Camera& start, double second, double reach);

}  // namespace grisaille::lab::soak
