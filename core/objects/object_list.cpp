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
  const size_t size = table_->object_size;
  Objects checked(*table_, first);
  checked.reserve(objects.count - first);
  checked.append(View{objects.table, objects.data + first * size, objects.count - first});
  Bytes bytes(checked.view().data, checked.view().data + checked.size() * size);
  for (const Field& field : fieldsOf(*table_)) {
    for (size_t i = 0; isText(field) && i < checked.size(); ++i) {
      const char* text = texts_.insert(checked.view().value(i, field).text).first->c_str();
      std::memcpy(bytes.data() + i * size + field.offset, &text, sizeof(text));
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
  add(one.view());
}

void ObjectList::add(const View& objects) {
  if (objects.count > 0) splice(size(), 0, objects);
}

void ObjectList::replace(const View& objects) {
  if (objects.count > 0 || size() > 0) splice(0, size(), objects);
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
  splice(index, 1, one.view());
}

void ObjectList::remove(size_t index) {
  requireIndex(index);
  splice(index, 1, {table_, nullptr, 0});
}

void ObjectList::clear() {
  replace({table_, nullptr, 0});
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
  splice(first, range.size(), moved.view());
}

void ObjectList::splice(size_t at, size_t removed, const View& added) {
  Bytes fresh = sound(added, 0);
  makeRoom(steps_, done_ + 1);
  makeRoom(kept_, kept_.size() + 1);
  makeRoom(bytes_, bytes_.size() + fresh.size());
  Step step{.at = at, .inserted = removed, .other = std::move(fresh)};
  step.other.reserve(std::max(step.other.size(), removed * table_->object_size));
  exchange(step);
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(done_), steps_.end());
  steps_.push_back(std::move(step));
  ++done_;
  noteChange(at);
}

// Swaps the objects in the list with the objects in the step.
void ObjectList::exchange(Step& step) {
  const size_t size = table_->object_size;
  const auto first = bytes_.begin() + static_cast<std::ptrdiff_t>(step.at * size);
  const auto last = first + static_cast<std::ptrdiff_t>(step.inserted * size);
  Bytes out(first, last);
  const size_t inserted = step.other.size() / size;
  const auto gap = bytes_.erase(first, last);
  bytes_.insert(gap, step.other.begin(), step.other.end());
  step.other = std::move(out);
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
  const size_t size = table_->object_size, before = this->size();
  makeRoom(kept_, kept_.size() + 1);
  size_t kept = 0;
  if (hasTexts(*table_)) {
    // Start with an empty set of texts: texts that only the steps used would accumulate.
    ObjectList fresh(*table_);
    fresh.bytes_ = fresh.sound(objects, 0);
    kept = sameObjects(view(), fresh.view());
    bytes_ = std::move(fresh.bytes_);
    texts_ = std::move(fresh.texts_);
  } else {
    // The leading objects that the list already holds are checked.
    const size_t held = sameBytes(view(), objects);
    const Bytes fresh = sound(objects, held);
    kept = held +
           sameBytes({table_, bytes_.data() + held * size, before - held}, viewOf(*table_, fresh));
    makeRoom(bytes_, held * size + fresh.size());
    bytes_.resize(held * size);
    bytes_.insert(bytes_.end(), fresh.begin(), fresh.end());
  }
  steps_.clear();
  done_ = 0;
  if (kept < before || this->size() > before) noteChange(kept);
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
