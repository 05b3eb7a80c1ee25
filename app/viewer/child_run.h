// SPDX-License-Identifier: MIT
// Runs one of this program's commands with --json as a child process, and follows its progress.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/process/child.h"

namespace grisaille::app::viewer {

class ChildRun {
 public:
  struct State {
    double done = 0;         // 0 ... 1, of the step in `text`
    std::string name, text;  // of the current step
  };
  struct Ended {
    std::string failure;  // why it failed or was cancelled, one line; "": it succeeded
    std::string last;     // its last line of JSON; "": none
  };

  // `program`: the program's path, and arguments before those of start().
  explicit ChildRun(std::vector<std::string> program = {"/proc/self/exe"})
      : program_(std::move(program)) {}
  ChildRun(const ChildRun&) = delete;
  ChildRun& operator=(const ChildRun&) = delete;

  // Starts the command; does nothing while one is started(). Throws kUnexpected.
  void start(const std::vector<std::string>& arguments);
  bool started() const { return child_ != nullptr; }  // until take() returns its end
  State state() const;

  // Ends the run; take() then returns the failure "cancelled".
  void cancel();

  // The end of a run, once; else none.
  std::optional<Ended> take();

 private:
  std::vector<std::string> program_;
  std::unique_ptr<Child> child_;
  bool cancelled_ = false;
};

}  // namespace grisaille::app::viewer
