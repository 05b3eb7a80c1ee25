// SPDX-License-Identifier: MIT
// Runs `grisaille tune` as a child process: its command, its progress and its result.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/viewer/child_run.h"
#include "core/effect/selection.h"
#include "core/scene/camera.h"

namespace grisaille::app::viewer {

struct TuneCommand {
  std::string scene = {};              // path; "": the built-in scene
  std::vector<std::string> pose = {};  // --animation and --time; empty: at rest
  scene::Camera camera = {};
  glm::uvec2 size = glm::uvec2(640, 360);        // pixels
  std::string backend = {}, device = {};         // "": no option
  const effect::Selection* effects = nullptr;    // starts from the values of those switched on
  std::string output = {};                       // compared with the truth
  double radius = 0.5;                           // of the truth, metres
  uint32_t samples = 256;                        // of the truth, rays per pixel
  double maxError = 0, budget = 0;               // RMSE; milliseconds; one of them is 0
  uint32_t evaluations = 80;                     // limit
  std::vector<effect::ParameterName> vary = {};  // the search changes these, from their values
  std::vector<std::string> pluginPaths = {};
};

// The arguments after the program's name, without --json.
std::vector<std::string> tuneArguments(const TuneCommand& command);

// The size of the tuned picture: the aspect ratio of `view`, about 640 x 360 pixels in all, and
// never larger than `view`.
glm::uvec2 tuneSize(glm::uvec2 view);

class TuneRun {
 public:
  struct State {
    double done = 0;   // 0 ... 1, of the step in `text`
    std::string text;  // current step
  };
  struct Outcome {
    // Found values of the varied parameters; none if the run failed: `text` says why.
    std::optional<std::vector<effect::ParameterValue>> values;
    std::string text;  // result or reason, one line
    std::string warning;
  };

  // `program`: the program's path, and arguments before those of tuneArguments().
  explicit TuneRun(std::vector<std::string> program = {"/proc/self/exe"})
      : run_(std::move(program)) {}

  // As those of ChildRun.
  void start(const TuneCommand& command) { run_.start(tuneArguments(command)); }
  bool started() const { return run_.started(); }
  State state() const;
  void cancel() { run_.cancel(); }

  // The outcome of a run that has ended, once; else none.
  std::optional<Outcome> take();

 private:
  ChildRun run_;
};

}  // namespace grisaille::app::viewer
