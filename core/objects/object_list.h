// SPDX-License-Identifier: MIT
// The objects that a user has made for one effect, and how they came about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/objects/object.h"

namespace grisaille::objects {

// Every change but assign() is one step that can be undone, without a limit. A step costs a few
// words beside the objects that it can bring back. A change that throws changes nothing; one that
// would change nothing is no step.
class ObjectList {
 public:
  // The table outlives the list.
  explicit ObjectList(const Table& table) : table_(&table) {}
  ObjectList(ObjectList&&) = default;
  ObjectList& operator=(ObjectList&&) = default;
  ObjectList(const ObjectList&) = delete;
  ObjectList& operator=(const ObjectList&) = delete;

  const Table& table() const { return *table_; }
  // The same objects and steps under another table of the same layout, whose plugin outlives this
  // one's. False, and nothing is changed, where the layout is another.
  bool adopt(const Table& table);

  // Each throws kObjectField, which names the object and the field, and checks all that it is
  // given.
  void add(const Object& object);
  void add(const View& objects);
  // The objects take the place of all that there are.
  void replace(const View& objects);
  // This and remove() throw kObjectIndex where there is no such object.
  void set(size_t index, const Object& object);

  void remove(size_t index);
  void clear();
  // The object at `from` gets the index `to`; those between close up. Nothing happens where either
  // is no index.
  void move(size_t from, size_t to);

  bool canUndo() const { return done_ > 0; }
  bool canRedo() const { return done_ < steps_.size(); }
  // Nothing happens where there is no such step.
  void undo();
  void redo();

  // As replace(), but no step: nothing before it can be undone.
  void assign(const View& objects);

  // Oldest first; valid until the next change.
  View view() const { return {table_, bytes_.data(), size()}; }
  size_t size() const { return bytes_.size() / table_->object_size; }
  Object object(size_t index) const { return view().object(index); }

  // 0 for a new list; grows with every change.
  uint64_t revision() const { return revision_; }

  // A lower bound of the number of leading objects that have stayed since that revision; 0 for a
  // revision that has not been.
  size_t keptSince(uint64_t revision) const;

 private:
  using Bytes = std::vector<std::byte>;

  // `inserted` objects stand in the list at `at` where `other` stood or, once it is undone, will
  // stand again.
  struct Step {
    size_t at;        // index
    size_t inserted;  // objects in the list now
    Bytes other;
  };
  struct Kept {
    uint64_t revision;
    size_t count;
  };

  void requireIndex(size_t index) const;
  void splice(size_t at, size_t removed, const View& added);
  void exchange(Step& step);
  void noteChange(size_t kept);
  Bytes sound(const View& objects, size_t first);

  const Table* table_;
  Bytes bytes_;
  std::unordered_set<std::string> texts_;  // of the list and its steps
  std::vector<Step> steps_;
  size_t done_ = 0;
  uint64_t revision_ = 0;
  // The fewest objects that were kept from each entry's revision on. Counts grow from entry to
  // entry: one that a later change fell below tells nothing more.
  std::vector<Kept> kept_;
};

}  // namespace grisaille::objects
