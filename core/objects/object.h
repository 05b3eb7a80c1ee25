// SPDX-License-Identifier: MIT
// Objects that users make for an effect, described by the effect's table: fields and their values,
// one object, and arrays of objects in the layout of the ABI.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::objects {

using Table = grisaille_object_desc;  // checked by effect::checkTable()
using Field = grisaille_field_desc;

constexpr double kFarthestPoint = 1e9;  // metres from the world's origin, on each axis
constexpr size_t kLongestText = 4096;   // bytes

inline std::span<const Field> fieldsOf(const Table& table) {
  return {table.fields, table.field_count};
}
inline bool isText(const Field& field) {
  return field.type == GRISAILLE_FIELD_TEXT || field.type == GRISAILLE_FIELD_FILE;
}
// Number of numbers in a field: 1, 3, or 0 for a text.
inline size_t componentsOf(const Field& field) {
  return field.type == GRISAILLE_FIELD_NUMBER ? 1 : isText(field) ? 0 : 3;
}

// The field with this key. Throws kObjectField with the nearest key.
const Field& fieldOf(const Table& table, std::string_view key);

// The value of one field: numbers or a text.
struct Value {
  std::array<double, 3> numbers{};
  std::string text;

  bool operator==(const Value&) const = default;
};

Value defaultOf(const Field& field);

// `value` in the form that a list stores: a direction is normalised. A direction whose length is 1
// within the rounding of floats stays unchanged, so that reading it back changes no bit. Throws
// kObjectField with the field's key, the value and the allowed range.
Value checked(const Field& field, Value value);

// Parses the form of the command line: "0.5", "#ff8000" (sRGB) for a colour, "1:2:3" for a point or
// a direction, a text unchanged. Throws kObjectField.
Value parseValue(const Field& field, std::string_view text);
// The text that parseValue() reads back; rounds a colour to 8 bits.
std::string textOf(const Field& field, const Value& value);

// One object: one value per field, in the table's order.
struct Object {
  std::vector<Value> values;

  explicit Object(const Table& table);  // all default values
  Value& at(const Table& table, std::string_view key);
  bool operator==(const Object&) const = default;
};

// A view of an array of objects, laid out as the table says.
struct View {
  const Table* table = nullptr;
  const std::byte* data = nullptr;
  size_t count = 0;

  Value value(size_t index, const Field& field) const;
  // The same for a field that is not a text. Unused numbers are 0.
  std::array<double, 3> numbers(size_t index, const Field& field) const;
  Object object(size_t index) const;
};

// Owns an array of objects and the texts that they point to.
class Objects {
 public:
  // `first`: the index of the first object in messages.
  explicit Objects(const Table& table, size_t first = 0) : table_(&table), first_(first) {}
  Objects(const Objects& other) : Objects(*other.table_) { append(other.view()); }
  Objects& operator=(const Objects& other);
  Objects(Objects&&) = default;
  Objects& operator=(Objects&&) = default;

  const Table& table() const { return *table_; }
  size_t size() const { return bytes_.size() / table_->object_size; }
  View view() const { return {table_, bytes_.data(), size()}; }

  // Checks every field. Throws kObjectField, "decals[3].colour ...", and then appends nothing.
  // `name`: the object's name in messages; "": the list's key and the index.
  void append(const Object& object, std::string_view name = {});
  // Appends objects of a table with the same layout. Checks every field.
  void append(const View& view);
  void reserve(size_t count) { bytes_.reserve(count * table_->object_size); }

 private:
  friend class ObjectList;  // takes the bytes over

  template <typename PutField>
  void write(std::string_view name, PutField&& putField);
  // `object`: byte offset. Both check the value.
  void putNumbers(size_t object, const Field& field, const std::array<double, 3>& numbers);
  void putText(size_t object, const Field& field, const std::string& text);

  const Table* table_;
  size_t first_;
  std::vector<std::byte> bytes_;
  std::unordered_set<std::string> texts_;
};

}  // namespace grisaille::objects
