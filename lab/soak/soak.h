// SPDX-License-Identifier: MIT
// Runs a soak on one device, and judges it: no frame over twice the median but for views that take
// as long without new shots, and memory that stays once the effect's limit is reached.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "core/gpu/device.h"
#include "core/scene/scene.h"
#include "lab/soak/plan.h"

namespace grisaille::lab::soak {

// What a frame did beside drawing. Only quiet frames are judged.
enum class Kind : uint8_t {
  kQuiet,   // drew, and placed new shots as they came
  kPlaces,  // placed shots anew, after an undo, a redo or a reload
  kReload,  // the first one after objects or effects were reloaded
  kResize,  // the first one of its size
};
constexpr size_t kKinds = 4;

struct Frame {
  Kind kind = Kind::kQuiet;
  double second = 0;     // since the start
  glm::uvec2 size = {};  // pixels
  double wall = 0;       // milliseconds until the device had finished
  double processor = 0;  // milliseconds of all of the program's threads
  // Of a frame that took long: judged() of the same view once more, without new shots. Else 0.
  double again = 0;
};

struct Sample {
  double second = 0;
  size_t shots = 0;
  double memory = 0;     // resident, MiB
  size_t resources = 0;  // that the effects hold
  uint64_t givenUp = 0;  // shots for which the limit leaves no room
};

struct Outcome {
  bool software = false;  // the device computes on the processor
  std::vector<Frame> frames = {};
  std::vector<Sample> samples = {};  // one a second
  size_t fired = 0;
  size_t events[6] = {};  // by Event
};

// Draws until the plan's time is over. `camera`: where it begins. The scene must not change. Throws
// the errors of the renderer, and Interrupted of app/truth.
Outcome run(const Plan& plan, const scene::Scene& scene, const scene::Camera& camera,
            gpu::Device& device);

// The milliseconds by which a frame is judged: of the processor on a software driver, where other
// programs disturb them less, otherwise of the clock.
double judged(const Outcome& outcome, const Frame& frame);

// One line for each fault; none: the soak holds.
std::vector<std::string> faultsOf(const Outcome& outcome);

// The figures as Markdown.
std::string tableOf(const Outcome& outcome);

}  // namespace grisaille::lab::soak
