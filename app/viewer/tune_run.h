// SPDX-License-Identifier: MIT
// Runs `grisaille tune` as a child process: its command, its progress and its result.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/process/child.h"
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
      : program_(std::move(program)) {}
  TuneRun(const TuneRun&) = delete;
  TuneRun& operator=(const TuneRun&) = delete;

  // Starts a run; does nothing while one is started(). Throws kUnexpected.
  void start(const TuneCommand& command);
  bool started() const { return child_ != nullptr; }  // until take() returns its outcome
  State state() const;

  // Ends the run; take() then returns the outcome "cancelled".
  void cancel();

  // The outcome of a run that has ended, once; else none.
  std::optional<Outcome> take();

 private:
  Outcome outcomeOf(const Child& ended) const;

  std::vector<std::string> program_;
  std::unique_ptr<Child> child_;
  bool cancelled_ = false;
};

}  // namespace grisaille::app::viewer
