// SPDX-License-Identifier: MIT
#include "core/objects/object.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/base/colour.h"
#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/base/utf8.h"

namespace grisaille::objects {
namespace {

using Numbers = std::array<double, 3>;

// For the squared length; twice the rounding error of floats.
constexpr double kUnitTolerance = 0x1p-22;

template <typename... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> what, Args&&... args) {
  throw Error(ErrorId::kObjectField, "{}", fmt::format(what, std::forward<Args>(args)...));
}

double squaredLength(const Numbers& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

Numbers unitOf(const Field& field, const Numbers& direction) {
  if (std::abs(squaredLength(direction) - 1) <= kUnitTolerance) return direction;
  const double largest =
      std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
  if (largest == 0) refuse("{} has no length; give three numbers that are not all 0", field.key);
  // Divide by the largest component first: squares of very large or small components would leave
  // the range of a double.
  const Numbers share{direction[0] / largest, direction[1] / largest, direction[2] / largest};
  const double length = std::sqrt(squaredLength(share));
  return {share[0] / length, share[1] / length, share[2] / length};
}

std::pair<double, double> rangeOf(const Field& field) {
  if (field.type == GRISAILLE_FIELD_COLOUR) return {0, 1};
  if (field.type == GRISAILLE_FIELD_POINT) return {-kFarthestPoint, kFarthestPoint};
  return {field.min, field.max};
}

[[noreturn]] void refuseNumber(const Field& field, size_t index, double value) {
  const std::string name =
      componentsOf(field) == 1 ? field.key : fmt::format("{}[{}]", field.key, index);
  if (!std::isfinite(value)) refuse("{} is {}, not a finite number", name, value);
  const auto [least, most] = rangeOf(field);
  refuse("{} is {}, out of {} to {}", name, value, least, most);
}

// See checked().
Numbers checkedNumbers(const Field& field, const Numbers& numbers) {
  const bool direction = field.type == GRISAILLE_FIELD_DIRECTION;
  const auto [least, most] = rangeOf(field);
  for (size_t i = 0; i < componentsOf(field); ++i) {
    const bool inside = direction || (numbers[i] >= least && numbers[i] <= most);
    if (!inside || !std::isfinite(numbers[i])) refuseNumber(field, i, numbers[i]);
  }
  return direction ? unitOf(field, numbers) : numbers;
}

void checkText(const Field& field, const std::string& text) {
  if (text.size() > kLongestText) {
    refuse("{} has {} bytes, more than {}", field.key, text.size(), kLongestText);
  }
  if (invalidUtf8(text) != std::string_view::npos) refuse("{} is not UTF-8", field.key);
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= ' ' && c != 127) continue;
    refuse("{} holds the control character {:#04x}; give one line of text", field.key,
           static_cast<unsigned char>(c));
  }
}

template <typename T>
void store(std::byte* object, const Field& field, const Numbers& numbers) {
  for (size_t i = 0; i < componentsOf(field); ++i) {
    // -0, which a tiny double may round to, becomes 0: a file may omit it as the default.
    const T value = static_cast<T>(numbers[i]) + T{0};
    std::memcpy(object + field.offset + i * sizeof(T), &value, sizeof(T));
  }
}

template <typename T>
Numbers load(const std::byte* object, const Field& field) {
  Numbers numbers{};
  for (size_t i = 0; i < componentsOf(field); ++i) {
    T value = 0;
    std::memcpy(&value, object + field.offset + i * sizeof(T), sizeof(T));
    numbers[i] = double{value};
  }
  return numbers;
}

bool isDouble(const Field& field) {
  return field.type == GRISAILLE_FIELD_NUMBER || field.type == GRISAILLE_FIELD_POINT;
}

Numbers parseColour(const Field& field, std::string_view text) {
  const auto linear = colourOf(text);
  if (!linear) refuse("{} is '{}', not of the form #rrggbb", field.key, oneLine(text));
  return {double{(*linear)[0]}, double{(*linear)[1]}, double{(*linear)[2]}};
}

Numbers parseNumbers(const Field& field, std::string_view text) {
  const size_t count = componentsOf(field);
  Numbers numbers{};
  std::string_view rest = text;
  for (size_t i = 0; i < count; ++i) {
    const size_t colon = i + 1 < count ? rest.find(':') : rest.size();
    const std::string_view one = rest.substr(0, colon);
    const auto [end, status] = std::from_chars(one.data(), one.data() + one.size(), numbers[i]);
    if (colon == std::string_view::npos || status != std::errc() ||
        end != one.data() + one.size()) {
      refuse("{} is '{}', not {}", field.key, oneLine(text),
             count == 1 ? "a number" : "three numbers with colons between them");
    }
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return numbers;
}

}  // namespace

const Field& fieldOf(const Table& table, std::string_view key) {
  for (const Field& field : fieldsOf(table)) {
    if (key == field.key) return field;
  }
  std::vector<std::string> keys;
  for (const Field& field : fieldsOf(table)) keys.emplace_back(field.key);
  const std::string near = nearest(key, keys);
  refuse("there is no field \"{}\"{}; {} have {}", oneLine(key),
         near.empty() ? "" : ", nearest is " + near, table.key, fmt::join(keys, ", "));
}

Value defaultOf(const Field& field) {
  if (isText(field)) return {.text = field.default_text};
  const double* numbers = field.default_value;
  return {.numbers = {numbers[0], numbers[1], numbers[2]}, .text = {}};
}

Value checked(const Field& field, Value value) {
  if (isText(field)) {
    checkText(field, value.text);
  } else {
    value.numbers = checkedNumbers(field, value.numbers);
  }
  return value;
}

Value parseValue(const Field& field, std::string_view text) {
  if (isText(field)) return checked(field, {.numbers = {}, .text = std::string(text)});
  const bool colour = field.type == GRISAILLE_FIELD_COLOUR;
  return checked(field, {.numbers = colour ? parseColour(field, text) : parseNumbers(field, text),
                         .text = {}});
}

std::string textOf(const Field& field, const Value& value) {
  const Numbers& n = value.numbers;
  if (isText(field)) return value.text;
  if (field.type == GRISAILLE_FIELD_NUMBER) return fmt::format("{}", n[0]);
  if (field.type != GRISAILLE_FIELD_COLOUR) return fmt::format("{}:{}:{}", n[0], n[1], n[2]);
  return colourText({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
}

Object::Object(const Table& table) {
  for (const Field& field : fieldsOf(table)) values.push_back(defaultOf(field));
}

Value& Object::at(const Table& table, std::string_view key) {
  return values[static_cast<size_t>(&fieldOf(table, key) - table.fields)];
}

Numbers View::numbers(size_t index, const Field& field) const {
  const std::byte* object = data + index * table->object_size;
  return isDouble(field) ? load<double>(object, field) : load<float>(object, field);
}

Value View::value(size_t index, const Field& field) const {
  if (!isText(field)) return {.numbers = numbers(index, field), .text = {}};
  const char* text = nullptr;
  std::memcpy(&text, data + index * table->object_size + field.offset, sizeof(text));
  return {.numbers = {}, .text = text != nullptr ? text : ""};
}

Object View::object(size_t index) const {
  Object object(*table);
  for (size_t i = 0; i < object.values.size(); ++i) {
    object.values[i] = value(index, table->fields[i]);
  }
  return object;
}

Objects& Objects::operator=(const Objects& other) {
  if (this != &other) *this = Objects(other);
  return *this;
}

// `putField(object, i)` puts the value of field i; `object`: byte offset.
template <typename PutField>
void Objects::write(std::string_view name, PutField&& putField) {
  const size_t before = bytes_.size();
  bytes_.resize(before + table_->object_size);
  try {
    for (size_t i = 0; i < table_->field_count; ++i) putField(before, i);
  } catch (const Error& error) {
    bytes_.resize(before);
    const size_t index = first_ + before / table_->object_size;
    throw Error(error.id(), "{}.{}",
                name.empty() ? fmt::format("{}[{}]", table_->key, index) : std::string(name),
                error.detail());
  } catch (...) {
    bytes_.resize(before);
    throw;
  }
}

void Objects::append(const Object& object, std::string_view name) {
  write(name, [&](size_t at, size_t i) {
    const Field& field = table_->fields[i];
    const Value& value = object.values[i];
    if (isText(field)) return putText(at, field, value.text);
    putNumbers(at, field, value.numbers);
  });
}

void Objects::append(const View& view) {
  const size_t before = bytes_.size();
  try {
    for (size_t n = 0; n < view.count; ++n) {
      write({}, [&](size_t at, size_t i) {
        const Field& field = table_->fields[i];
        if (isText(field)) return putText(at, field, view.value(n, field).text);
        putNumbers(at, field, view.numbers(n, field));
      });
    }
  } catch (...) {
    bytes_.resize(before);
    throw;
  }
}

void Objects::putNumbers(size_t object, const Field& field, const Numbers& numbers) {
  std::byte* at = bytes_.data() + object;
  const Numbers good = checkedNumbers(field, numbers);
  if (isDouble(field)) return store<double>(at, field, good);
  store<float>(at, field, good);
}

void Objects::putText(size_t object, const Field& field, const std::string& text) {
  checkText(field, text);
  const char* kept = texts_.insert(text).first->c_str();
  std::memcpy(bytes_.data() + object + field.offset, &kept, sizeof(kept));
}

}  // namespace grisaille::objects
