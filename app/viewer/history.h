// SPDX-License-Identifier: MIT
// One undo history for settings and objects. A settings step stores only the changed lines; an
// object step stores only the number of steps in the object list. 100,000 steps therefore cost
// little memory.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/effect/selection.h"
#include "core/objects/object_list.h"

namespace grisaille::app::viewer {

class History {
 public:
  using Restore = std::function<void(const effect::Selection::State&)>;
  using ListOf = std::function<objects::ObjectList*(std::string_view effect)>;

  // `now`: the state before the first step. undo() and redo() pass the whole state to `restore` for
  // a settings step, and undo or redo the list that `listOf` returns for an object step. Null: the
  // effect has no list any more, and the step does nothing.
  History(const effect::Selection::State& now, Restore restore, ListOf listOf);

  // Forgets all steps: `now` is the state before the first one.
  void begin(const effect::Selection::State& now);

  // Call when a change is complete (the user releases a slider): adds a step if `now` differs from
  // the state at the last step. `what` names the step: "ssao.radius". Drops undone steps.
  void noteSettings(const effect::Selection::State& now, std::string what);

  // Records that the list of `effect` did this number of steps; 0: does nothing. `joins`: merges
  // them into the last step if that is of the same list and nothing is undone. A held spray passes
  // false first, then true.
  void noteObjects(const std::string& effect, size_t steps, std::string what, bool joins = false);

  bool canUndo() const { return done_ > 0; }
  bool canRedo() const { return done_ < steps_.size(); }
  // Each does nothing without a step to undo or redo.
  void undo();
  void redo();

  // The name of the step that the next undo() or redo() takes; "": none.
  std::string undoName() const { return canUndo() ? steps_[done_ - 1].what : std::string(); }
  std::string redoName() const { return canRedo() ? steps_[done_].what : std::string(); }

 private:
  // A state is stored as a list of lines: one per effect, followed by one per value of the effect.
  // A change replaces one run of lines by another.
  struct Line {
    std::string key, value;  // for an effect, `value` is "on" or "off"
    bool effect = false;

    bool operator==(const Line&) const = default;
  };
  struct Step {
    std::string what;
    // For settings: at line `at`, `after` replaces `before`.
    size_t at = 0;
    std::vector<Line> before, after;
    // For objects: number of steps in the effect's list; 0: a settings step.
    size_t objectSteps = 0;
    std::string effect;
  };

  static std::vector<Line> linesOf(const effect::Selection::State& state);
  static effect::Selection::State stateOf(const std::vector<Line>& lines);

  void add(Step step);
  void forgetUndone();
  // Replaces the lines `from` at `at` by `to`, and restores that state.
  void change(size_t at, const std::vector<Line>& from, const std::vector<Line>& to);

  Restore restore_;
  ListOf listOf_;
  std::vector<Line> now_;  // the state at the last step
  std::vector<Step> steps_;
  size_t done_ = 0;
};

}  // namespace grisaille::app::viewer
