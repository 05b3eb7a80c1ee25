// SPDX-License-Identifier: MIT
#include "core/objects/object_list.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/error.h"

namespace grisaille::objects {
namespace {

// Reserves memory for `size` elements, so that later insertions cannot throw. Reserves twice as
// much when it grows, which amortises the moves.
template <typename T>
void makeRoom(std::vector<T>& vector, size_t size) {
  if (size > vector.capacity()) vector.reserve(2 * size);
}

bool hasTexts(const Table& table) {
  return std::ranges::any_of(fieldsOf(table), isText);
}

View viewOf(const Table& table, const std::vector<std::byte>& bytes) {
  return {&table, bytes.data(), bytes.size() / table.object_size};
}

// For objects with texts, whose bytes are addresses: compares the fields instead of the bytes.
size_t sameObjects(const View& a, const View& b) {
  const size_t count = std::min(a.count, b.count);
  size_t same = 0;
  while (same < count && a.object(same) == b.object(same)) ++same;
  return same;
}

size_t sameBytes(const View& a, const View& b) {
  const size_t bytes = std::min(a.count, b.count) * a.table->object_size;
  const std::byte* differ = std::mismatch(a.data, a.data + bytes, b.data).first;
  return static_cast<size_t>(differ - a.data) / a.table->object_size;
}

}  // namespace

// Checks the objects from index `first` on and returns their bytes, with texts that this list owns.
ObjectList::Bytes ObjectList::sound(const View& objects, size_t first) {
  Objects checked(*table_, first);
  checked.reserve(objects.count - first);
  checked.append(
      View{objects.table, objects.data + first * table_->object_size, objects.count - first});
  return taken(std::move(checked));
}

// The bytes of checked objects, with texts that this list owns.
ObjectList::Bytes ObjectList::taken(Objects&& objects) {
  Bytes bytes = std::move(objects.bytes_);
  const View view = viewOf(*table_, bytes);
  for (const Field& field : fieldsOf(*table_)) {
    for (size_t i = 0; isText(field) && i < view.count; ++i) {
      const char* text = texts_.insert(view.value(i, field).text).first->c_str();
      std::memcpy(bytes.data() + i * table_->object_size + field.offset, &text, sizeof(text));
    }
  }
  return bytes;
}

bool ObjectList::adopt(const Table& table) {
  const auto same = [](const Field& a, const Field& b) {
    return std::string_view(a.key) == b.key && a.type == b.type && a.offset == b.offset &&
           a.min == b.min && a.max == b.max;
  };
  if (std::string_view(table.key) != table_->key || table.object_size != table_->object_size ||
      !std::ranges::equal(fieldsOf(table), fieldsOf(*table_), same)) {
    return false;
  }
  table_ = &table;
  return true;
}

void ObjectList::add(const Object& object) {
  Objects one(*table_);
  one.append(object);
  add(std::move(one));
}

void ObjectList::add(const View& objects) {
  if (objects.count > 0) splice(size(), 0, sound(objects, 0));
}

void ObjectList::add(Objects&& objects) {
  if (objects.size() > 0) splice(size(), 0, taken(std::move(objects)));
}

void ObjectList::replace(const View& objects) {
  if (objects.count > 0 || size() > 0) splice(0, size(), sound(objects, 0));
}

void ObjectList::replace(Objects&& objects) {
  if (objects.size() > 0 || size() > 0) splice(0, size(), taken(std::move(objects)));
}

void ObjectList::requireIndex(size_t index) const {
  if (index < size()) return;
  throw Error(ErrorId::kObjectIndex, "there is no {}[{}]; the list has {}", table_->key, index,
              size());
}

void ObjectList::set(size_t index, const Object& object) {
  requireIndex(index);
  Objects one(*table_);
  one.append(object);
  if (one.view().object(0) == this->object(index)) return;
  splice(index, 1, taken(std::move(one)));
}

void ObjectList::remove(size_t index) {
  requireIndex(index);
  splice(index, 1, {});
}

void ObjectList::clear() {
  if (size() > 0) splice(0, size(), {});
}

void ObjectList::move(size_t from, size_t to) {
  if (from == to || from >= size() || to >= size()) return;
  const size_t first = std::min(from, to), last = std::max(from, to);
  std::vector<Object> range;
  for (size_t i = first; i <= last; ++i) range.push_back(object(i));
  if (from < to) {
    std::rotate(range.begin(), range.begin() + 1, range.end());
  } else {
    std::rotate(range.begin(), range.end() - 1, range.end());
  }
  Objects moved(*table_);
  for (const Object& object : range) moved.append(object);
  splice(first, range.size(), taken(std::move(moved)));
}

void ObjectList::splice(size_t at, size_t removed, Bytes added) {
  makeRoom(steps_, done_ + 1);
  makeRoom(kept_, kept_.size() + 1);
  Step step{.at = at, .inserted = removed, .other = std::move(added)};
  exchange(step);
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(done_), steps_.end());
  steps_.push_back(std::move(step));
  ++done_;
  noteChange(at);
}

// Swaps the objects in the list with the objects in the step. If memory runs out, it throws before
// it changes anything.
void ObjectList::exchange(Step& step) {
  const size_t size = table_->object_size;
  const size_t inserted = step.other.size() / size;
  if (step.inserted == this->size()) {  // a list that is swapped whole need not be copied
    bytes_.swap(step.other);
  } else {
    makeRoom(bytes_, bytes_.size() + step.other.size());
    const auto first = bytes_.begin() + static_cast<std::ptrdiff_t>(step.at * size);
    const auto last = first + static_cast<std::ptrdiff_t>(step.inserted * size);
    Bytes out(first, last);
    const auto gap = bytes_.erase(first, last);
    bytes_.insert(gap, step.other.begin(), step.other.end());
    step.other = std::move(out);
  }
  step.inserted = inserted;
}

void ObjectList::undo() {
  if (!canUndo()) return;
  makeRoom(kept_, kept_.size() + 1);
  Step& step = steps_[done_ - 1];
  exchange(step);
  --done_;
  noteChange(step.at);
}

void ObjectList::redo() {
  if (!canRedo()) return;
  makeRoom(kept_, kept_.size() + 1);
  Step& step = steps_[done_];
  exchange(step);
  ++done_;
  noteChange(step.at);
}

void ObjectList::assign(const View& objects) {
  if (hasTexts(*table_)) {
    Objects checked(*table_);
    checked.append(objects);
    return assign(std::move(checked));
  }
  // The leading objects that the list already holds are checked.
  const size_t held = sameBytes(view(), objects);
  assign(held, sound(objects, held));
}

void ObjectList::assign(Objects&& objects) {
  if (!hasTexts(*table_)) return assign(0, std::move(objects.bytes_));
  // Start with an empty set of texts: texts that only the steps used would accumulate.
  ObjectList fresh(*table_);
  fresh.bytes_ = fresh.taken(std::move(objects));
  const size_t kept = sameObjects(view(), fresh.view());
  makeRoom(kept_, kept_.size() + 1);
  const size_t before = size();
  bytes_ = std::move(fresh.bytes_);
  texts_ = std::move(fresh.texts_);
  endSteps(before, kept);
}

// Replaces the objects after the first `held`, which stay, by `fresh`. Objects without texts.
void ObjectList::assign(size_t held, Bytes fresh) {
  const size_t size = table_->object_size, before = this->size();
  const View after{table_, bytes_.data() + held * size, before - held};
  const size_t kept = held + sameBytes(after, viewOf(*table_, fresh));
  makeRoom(kept_, kept_.size() + 1);
  if (held == 0) {
    bytes_ = std::move(fresh);
  } else {
    makeRoom(bytes_, held * size + fresh.size());
    bytes_.resize(held * size);
    bytes_.insert(bytes_.end(), fresh.begin(), fresh.end());
  }
  endSteps(before, kept);
}

// `before`: the list's size before it was assigned, of which the first `kept` stay.
void ObjectList::endSteps(size_t before, size_t kept) {
  steps_.clear();
  done_ = 0;
  if (kept < before || size() > before) noteChange(kept);
}

void ObjectList::noteChange(size_t kept) {
  ++revision_;
  while (!kept_.empty() && kept_.back().count >= kept) kept_.pop_back();
  kept_.push_back({revision_, kept});
}

size_t ObjectList::keptSince(uint64_t revision) const {
  if (revision > revision_) return 0;
  const auto first =
      std::upper_bound(kept_.begin(), kept_.end(), revision,
                       [](uint64_t wanted, const Kept& kept) { return wanted < kept.revision; });
  return first == kept_.end() ? size() : first->count;
}

}  // namespace grisaille::objects
