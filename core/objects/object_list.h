// SPDX-License-Identifier: MIT
// The objects that a user made for one effect, with their history for undo.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/objects/object.h"

namespace grisaille::objects {

// Every change except assign() is one step of undo, without a limit. A step stores only the objects
// that it can restore, and a few bytes more. A call that throws changes nothing. A call that would
// change nothing adds no step.
class ObjectList {
 public:
  // The table must outlive the list.
  explicit ObjectList(const Table& table) : table_(&table) {}
  ObjectList(ObjectList&&) = default;
  ObjectList& operator=(ObjectList&&) = default;
  ObjectList(const ObjectList&) = delete;
  ObjectList& operator=(const ObjectList&) = delete;

  const Table& table() const { return *table_; }
  // Replaces the table by another of the same layout, such as the table of a reloaded plugin, which
  // must outlive the list. Keeps objects and steps. Returns false and changes nothing if the layout
  // differs.
  bool adopt(const Table& table);

  // All changes check every field of their objects, and throw kObjectField, which names the object
  // and the field.
  void add(const Object& object);
  void add(const View& objects);
  // Replaces all objects of the list.
  void replace(const View& objects);
  // The same for objects of a table of the same layout, which are taken over without a second
  // check.
  void add(Objects&& objects);
  void replace(Objects&& objects);
  // set() and remove() throw kObjectIndex if the index is out of range.
  void set(size_t index, const Object& object);

  void remove(size_t index);
  void clear();
  // Moves the object at index `from` to index `to`; the objects between shift by one. Does nothing
  // if an index is out of range.
  void move(size_t from, size_t to);

  bool canUndo() const { return done_ > 0; }
  bool canRedo() const { return done_ < steps_.size(); }
  // Both do nothing if there is no step.
  void undo();
  void redo();

  // Same as replace(), but not a step: it clears all steps.
  void assign(const View& objects);
  void assign(Objects&& objects);

  // Oldest first; valid until the next change.
  View view() const { return {table_, bytes_.data(), size()}; }
  size_t size() const { return bytes_.size() / table_->object_size; }
  Object object(size_t index) const { return view().object(index); }

  // 0 for a new list; increases with every change.
  uint64_t revision() const { return revision_; }

  // A lower bound of the number of leading objects unchanged since `revision`; 0 for a revision
  // that the list has not reached.
  size_t keptSince(uint64_t revision) const;

 private:
  using Bytes = std::vector<std::byte>;

  // A change at index `at`: `inserted` objects of the list replaced `other`. Undoing the step swaps
  // them; redoing swaps them back.
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
  void splice(size_t at, size_t removed, Bytes added);
  void exchange(Step& step);
  void noteChange(size_t kept);
  Bytes sound(const View& objects, size_t first);
  Bytes taken(Objects&& objects);
  void assign(size_t held, Bytes fresh);
  void endSteps(size_t before, size_t kept);

  const Table* table_;
  Bytes bytes_;
  std::unordered_set<std::string> texts_;  // texts of the list and of its steps
  std::vector<Step> steps_;
  size_t done_ = 0;
  uint64_t revision_ = 0;
  // Each entry: the least number of leading objects unchanged by this revision and all later ones.
  // Counts increase from entry to entry; a change removes the entries with an equal or higher
  // count.
  std::vector<Kept> kept_;
};

}  // namespace grisaille::objects
