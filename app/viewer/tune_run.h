// SPDX-License-Identifier: MIT
// `grisaille tune` beside the window: what it is asked, how far it is, what it found.
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
  std::string scene = {};  // a file; "": the built-in scene
  scene::Camera camera = {};
  glm::uvec2 size = glm::uvec2(640, 360);        // pixels
  std::string backend = {}, device = {};         // "": left out
  const effect::Selection* effects = nullptr;    // those that are on run
  std::string output = {};                       // that is compared with the truth
  double radius = 0.5;                           // of the truth, metres
  uint32_t samples = 256;                        // of the truth, rays a pixel
  double maxError = 0, budget = 0;               // RMSE, milliseconds; one of them is 0
  uint32_t evaluations = 80;                     // at most
  std::vector<effect::ParameterName> vary = {};  // all others stay as they are
  std::vector<std::string> pluginPaths = {};
};

// The arguments after the program's name, but for --json.
std::vector<std::string> tuneArguments(const TuneCommand& command);

// Of the view's shape, with about as many pixels as a study has, but no more than the view.
glm::uvec2 tuneSize(glm::uvec2 view);

class TuneRun {
 public:
  struct State {
    double done = 0;   // share of what `text` says it does
    std::string text;  // what it does now
  };
  struct Outcome {
    // What was found for the parameters that may change; none: why is in `text`.
    std::optional<std::vector<effect::ParameterValue>> values;
    std::string text;  // one line
    std::string warning;
  };

  // `program`: the words before the arguments.
  explicit TuneRun(std::vector<std::string> program = {"/proc/self/exe"})
      : program_(std::move(program)) {}
  TuneRun(const TuneRun&) = delete;
  TuneRun& operator=(const TuneRun&) = delete;

  // One at a time. Throws kUnexpected.
  void start(const TuneCommand& command);
  bool started() const { return child_ != nullptr; }  // and its outcome is not yet taken
  State state() const;

  // take() says soon that it was cancelled.
  void cancel();

  // Of a run that has ended since the last call.
  std::optional<Outcome> take();

 private:
  Outcome outcomeOf(const Child& ended) const;

  std::vector<std::string> program_;
  std::unique_ptr<Child> child_;
  bool cancelled_ = false;
};

}  // namespace grisaille::app::viewer
