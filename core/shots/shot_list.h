// SPDX-License-Identifier: MIT
// The user's shots and how they came about.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::shots {

// Every change is one step that can be undone, without a limit. The steps cost a few words each,
// beside the shots that they can bring back. A change that throws changes nothing; one that would
// change nothing is no step.
class ShotList {
 public:
  ShotList() = default;
  ShotList(const ShotList&) = delete;
  ShotList& operator=(const ShotList&) = delete;

  // Appends the shots as makeShot() leaves them. Throws as it does.
  void fire(const grisaille_shot& shot) { fire(std::span(&shot, 1)); }
  void fire(std::span<const grisaille_shot> shots);

  // The shots take the place of all there are. Throws as makeShot() does.
  void replace(std::span<const grisaille_shot> shots);
  void clear() { replace({}); }

  bool canUndo() const { return done_ > 0; }
  bool canRedo() const { return done_ < steps_.size(); }
  // Nothing happens where there is no such step.
  void undo();
  void redo();

  // Oldest first; valid until the next change.
  std::span<const grisaille_shot> shots() const { return {shots_.data(), count_}; }

  // 0 for a new list; grows with every change.
  uint64_t revision() const { return revision_; }

  // So many of the first shots have stayed since that revision. May be too low, never too high; 0
  // for a revision that has not been.
  size_t keptSince(uint64_t revision) const;

 private:
  struct Step {
    size_t before;  // shots before and after it
    size_t after;
    // What it replaced or, once undone, what it put there; null: it fired.
    std::unique_ptr<std::vector<grisaille_shot>> other;
  };
  struct Kept {
    uint64_t revision;
    size_t count;
  };

  void addStep(Step step);
  void noteChange(size_t kept);

  std::vector<grisaille_shot> shots_;  // behind count_: what redo() fires again
  size_t count_ = 0;
  std::vector<Step> steps_;
  size_t done_ = 0;
  uint64_t revision_ = 0;
  // The fewest shots that were kept from each entry's revision on. Counts grow from entry to entry,
  // as one that a later change fell below tells nothing more.
  std::vector<Kept> kept_;
};

}  // namespace grisaille::shots
