// SPDX-License-Identifier: MIT
// One line of undo over settings and objects. A settings step keeps only what it changed, a step of
// objects only how many steps of their list it is, so that a hundred thousand cost little.
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
  using ListOf = std::function<objects::ObjectList&(std::string_view effect)>;

  // `now`: the state before the first step. undo() and redo() hand a whole state to `restore`, and
  // undo and redo steps of the list that `listOf` names, which must be there for every effect that
  // was noted.
  History(const effect::Selection::State& now, Restore restore, ListOf listOf);

  // To be called when a change is complete (a slider let go): adds a step if `now` differs from the
  // state at the last one. `what` names it: "ssao.radius". Steps that were undone are forgotten.
  void noteSettings(const effect::Selection::State& now, std::string what);

  // So many steps of that list were done; 0: nothing happens. `joins`: they go on with the step
  // before, if that is the same list's and nothing is undone (a held spray passes false first, then
  // true).
  void noteObjects(const std::string& effect, size_t steps, std::string what, bool joins = false);

  bool canUndo() const { return done_ > 0; }
  bool canRedo() const { return done_ < steps_.size(); }
  // Nothing happens where there is no such step.
  void undo();
  void redo();

  // What the next undo() or redo() is about; "": there is none.
  std::string undoName() const { return canUndo() ? steps_[done_ - 1].what : std::string(); }
  std::string redoName() const { return canRedo() ? steps_[done_].what : std::string(); }

 private:
  // A state as a list of lines, so that a change is a run of lines that takes another's place: a
  // line for each effect, one for each of its values behind it.
  struct Line {
    std::string key, value;  // of an effect: "on" or "off"
    bool effect = false;

    bool operator==(const Line&) const = default;
  };
  struct Step {
    std::string what;
    // Of settings: at line `at`, `after` takes the place of `before`.
    size_t at = 0;
    std::vector<Line> before, after;
    // Of objects: number of steps of an effect's list; 0: the step is of settings.
    size_t objectSteps = 0;
    std::string effect;
  };

  static std::vector<Line> linesOf(const effect::Selection::State& state);
  static effect::Selection::State stateOf(const std::vector<Line>& lines);

  void add(Step step);
  void forgetUndone();
  // Puts `to` where `from` stands in the settings.
  void change(size_t at, const std::vector<Line>& from, const std::vector<Line>& to);

  Restore restore_;
  ListOf listOf_;
  std::vector<Line> now_;  // the state at the last step
  std::vector<Step> steps_;
  size_t done_ = 0;
};

}  // namespace grisaille::app::viewer
