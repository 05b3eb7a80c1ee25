// SPDX-License-Identifier: MIT
#include "app/viewer/history.h"

#include <algorithm>
#include <utility>

namespace grisaille::app::viewer {
namespace {

constexpr const char* kOn = "on";
constexpr const char* kOff = "off";

}  // namespace

History::History(const effect::Selection::State& now, Restore restore, ListOf listOf)
    : restore_(std::move(restore)), listOf_(std::move(listOf)), now_(linesOf(now)) {}

void History::begin(const effect::Selection::State& now) {
  steps_.clear();
  done_ = 0;
  now_ = linesOf(now);
}

std::vector<History::Line> History::linesOf(const effect::Selection::State& state) {
  std::vector<Line> lines;
  for (const effect::Selection::State::One& one : state.effects) {
    lines.push_back({.key = one.key, .value = one.on ? kOn : kOff, .effect = true});
    for (const auto& [key, text] : one.values) lines.push_back({.key = key, .value = text});
  }
  return lines;
}

effect::Selection::State History::stateOf(const std::vector<Line>& lines) {
  effect::Selection::State state;
  for (const Line& line : lines) {
    if (line.effect) {
      state.effects.push_back({.key = line.key, .on = line.value == kOn, .values = {}});
    } else {
      state.effects.back().values.emplace_back(line.key, line.value);
    }
  }
  return state;
}

void History::noteSettings(const effect::Selection::State& now, std::string what) {
  std::vector<Line> lines = linesOf(now);
  const auto [oldFirst, newFirst] = std::ranges::mismatch(now_, lines);
  if (oldFirst == now_.end() && newFirst == lines.end()) return;
  auto oldLast = now_.end(), newLast = lines.end();
  while (oldLast != oldFirst && newLast != newFirst && *(oldLast - 1) == *(newLast - 1)) {
    --oldLast;
    --newLast;
  }
  add({.what = std::move(what),
       .at = static_cast<size_t>(oldFirst - now_.begin()),
       .before = {oldFirst, oldLast},
       .after = {newFirst, newLast},
       .objectSteps = 0,
       .effect = {}});
  now_ = std::move(lines);
}

void History::noteObjects(const std::string& effect, size_t steps, std::string what, bool joins) {
  if (steps == 0) return;
  if (joins && canUndo() && !canRedo() && steps_.back().objectSteps > 0 &&
      steps_.back().effect == effect) {
    steps_.back().objectSteps += steps;
    return;
  }
  add({.what = std::move(what),
       .at = 0,
       .before = {},
       .after = {},
       .objectSteps = steps,
       .effect = effect});
}

void History::undo() {
  if (!canUndo()) return;
  const Step& step = steps_[done_ - 1];
  if (step.objectSteps == 0) {
    change(step.at, step.after, step.before);
  } else {
    objects::ObjectList* list = listOf_(step.effect);
    for (size_t i = 0; list != nullptr && i < step.objectSteps; ++i) list->undo();
  }
  --done_;
}

void History::redo() {
  if (!canRedo()) return;
  const Step& step = steps_[done_];
  if (step.objectSteps == 0) {
    change(step.at, step.before, step.after);
  } else {
    objects::ObjectList* list = listOf_(step.effect);
    for (size_t i = 0; list != nullptr && i < step.objectSteps; ++i) list->redo();
  }
  ++done_;
}

void History::add(Step step) {
  forgetUndone();
  steps_.push_back(std::move(step));
  ++done_;
}

void History::forgetUndone() {
  steps_.erase(steps_.begin() + static_cast<ptrdiff_t>(done_), steps_.end());
}

void History::change(size_t at, const std::vector<Line>& from, const std::vector<Line>& to) {
  std::vector<Line> lines(now_.begin(), now_.begin() + static_cast<ptrdiff_t>(at));
  lines.insert(lines.end(), to.begin(), to.end());
  lines.insert(lines.end(), now_.begin() + static_cast<ptrdiff_t>(at + from.size()), now_.end());
  restore_(stateOf(lines));
  now_ = std::move(lines);
}

}  // namespace grisaille::app::viewer
