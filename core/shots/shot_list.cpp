// SPDX-License-Identifier: MIT
#include "core/shots/shot_list.h"

#include <algorithm>
#include <utility>

#include "core/shots/shot.h"

namespace grisaille::shots {
namespace {

// Memory for `size` elements, so that what follows cannot fail; and for as many again, so that what
// is fired next need not move them.
template <typename T>
void makeRoom(std::vector<T>& vector, size_t size) {
  if (size > vector.capacity()) vector.reserve(2 * size);
}

}  // namespace

void ShotList::fire(std::span<const grisaille_shot> shots) {
  if (shots.empty()) return;
  const std::vector<grisaille_shot> fired = checked(shots);
  const size_t before = count_;
  makeRoom(shots_, before + fired.size());
  makeRoom(steps_, done_ + 1);
  makeRoom(kept_, kept_.size() + 1);
  shots_.resize(before);
  shots_.insert(shots_.end(), fired.begin(), fired.end());
  addStep({.before = before, .after = shots_.size(), .other = nullptr});
  noteChange(before);
}

void ShotList::replace(std::span<const grisaille_shot> shots) {
  if (shots.empty() && count_ == 0) return;
  const std::vector<grisaille_shot> sound = checked(shots);
  auto other = std::make_unique<std::vector<grisaille_shot>>();
  makeRoom(*other, sound.size());
  other->assign(sound.begin(), sound.end());
  makeRoom(steps_, done_ + 1);
  makeRoom(kept_, kept_.size() + 1);
  const size_t before = count_;
  shots_.resize(before);
  std::swap(shots_, *other);
  addStep({.before = before, .after = shots_.size(), .other = std::move(other)});
  noteChange(0);
}

void ShotList::undo() {
  if (!canUndo()) return;
  makeRoom(kept_, kept_.size() + 1);
  const Step& step = steps_[--done_];
  if (step.other) std::swap(shots_, *step.other);
  count_ = step.before;
  noteChange(step.other ? 0 : step.before);
}

void ShotList::redo() {
  if (!canRedo()) return;
  makeRoom(kept_, kept_.size() + 1);
  const Step& step = steps_[done_++];
  if (step.other) std::swap(shots_, *step.other);
  count_ = step.after;
  noteChange(step.other ? 0 : step.before);
}

void ShotList::addStep(Step step) {
  count_ = step.after;
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(done_), steps_.end());
  steps_.push_back(std::move(step));
  ++done_;
}

void ShotList::noteChange(size_t kept) {
  ++revision_;
  while (!kept_.empty() && kept_.back().count >= kept) kept_.pop_back();
  kept_.push_back({revision_, kept});
}

size_t ShotList::keptSince(uint64_t revision) const {
  if (revision > revision_) return 0;
  const auto first =
      std::upper_bound(kept_.begin(), kept_.end(), revision,
                       [](uint64_t wanted, const Kept& kept) { return wanted < kept.revision; });
  return first == kept_.end() ? count_ : first->count;
}

}  // namespace grisaille::shots
