// SPDX-License-Identifier: MIT
#include "core/objects/object_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"
#include "core/objects/plain_file.h"

namespace grisaille::objects {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;

// A SAX reader: a DOM of a million objects would take several GiB.
class Reader : public nlohmann::json_sax<json> {
 public:
  explicit Reader(const Table& table) : objects_(table), blank_(table), object_(table) {}

  Objects take() {
    if (!hasVersion_) refuse("", "has no \"version\"");
    if (!hasList_) refuse("", fmt::format("has no \"{}\"", table().key));
    return std::move(objects_);
  }

  bool null() override { return wrong("null"); }
  bool boolean(bool) override { return wrong("a truth value"); }
  bool binary(binary_t&) override { return wrong("binary"); }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }

  bool string(string_t& text) override {
    if (place_ != Place::kObject || !isText(field())) return wrong("a text");
    object_.values[index_].text = text;
    return true;
  }

  bool key(string_t& key) override {
    key_ = key;
    if (place_ == Place::kRoot) {
      bool& given = key == "version" ? hasVersion_ : hasList_;
      if (key == "version" || key == table().key) {
        if (std::exchange(given, true)) refuse(key, "is given twice");
        return true;
      }
      refuse("", fmt::format("has a member \"{}\", which is neither version nor {}", oneLine(key),
                             table().key));
    }
    try {
      index_ = static_cast<size_t>(&fieldOf(table(), key) - table().fields);
    } catch (const Error& error) {
      refuse(objectName(), error.detail());
    }
    if (given_[index_]) refuse(fieldName(), "is given twice");
    given_[index_] = true;
    return true;
  }

  bool start_object(size_t) override {
    if (place_ == Place::kTop) {
      place_ = Place::kRoot;
    } else if (place_ == Place::kList) {
      place_ = Place::kObject;
      object_ = blank_;
      given_.assign(table().field_count, false);
    } else {
      return wrong("an object");
    }
    return true;
  }

  bool end_object() override {
    if (place_ == Place::kRoot) {
      place_ = Place::kTop;
      return true;
    }
    place_ = Place::kList;
    for (size_t i = 0; i < given_.size(); ++i) {
      const Field& field = table().fields[i];
      if (given_[i] || (field.flags & GRISAILLE_FIELD_REQUIRED) == 0) continue;
      refuse(objectName(), fmt::format("has no \"{}\"", field.key));
    }
    try {
      objects_.append(object_);
    } catch (const Error& error) {
      throw Error(ErrorId::kObjectFileInvalid, "{}", error.detail());
    }
    return true;
  }

  bool start_array(size_t) override {
    if (place_ == Place::kRoot && key_ == table().key) {
      place_ = Place::kList;
    } else if (place_ == Place::kObject && componentsOf(field()) == 3) {
      place_ = Place::kVector;
      count_ = 0;
    } else {
      return wrong("an array");
    }
    return true;
  }

  bool end_array() override {
    if (place_ == Place::kList) {
      place_ = Place::kRoot;
      return true;
    }
    if (count_ != 3) refuse(fieldName(), fmt::format("has {} numbers, not 3", count_));
    place_ = Place::kObject;
    return true;
  }

  // The parser's error for a number beyond a double's range does not name the place.
  bool parse_error(size_t, const std::string&, const json::exception& error) override {
    const bool inObject = place_ == Place::kVector || (place_ == Place::kObject && given_[index_]);
    throw Error(ErrorId::kObjectFileInvalid, "{}{}", inObject ? "in " + fieldName() + ": " : "",
                oneLine(error.what()));
  }

 private:
  enum class Place : uint8_t { kTop, kRoot, kList, kObject, kVector };

  const Table& table() const { return objects_.table(); }
  const Field& field() const { return table().fields[index_]; }
  std::string objectName() const { return fmt::format("{}[{}]", table().key, objects_.size()); }
  std::string fieldName() const { return objectName() + "." + field().key; }

  [[noreturn]] static void refuse(const std::string& name, const std::string& what) {
    throw Error(ErrorId::kObjectFileInvalid, "{}{}{}", name, name.empty() ? "it " : " ", what);
  }

  bool number(double value) {
    if (place_ == Place::kVector) {
      if (count_ == 3) refuse(fieldName(), "has more than 3 numbers");
      object_.values[index_].numbers[count_++] = value;
    } else if (place_ == Place::kObject && componentsOf(field()) == 1) {
      object_.values[index_].numbers[0] = value;
    } else if (place_ == Place::kRoot && key_ == "version") {
      if (value == kVersion) return true;
      throw Error(ErrorId::kObjectFileVersion, "version is {}, not {}", value, kVersion);
    } else {
      return wrong("a number");
    }
    return true;
  }

  bool wrong(const char* found) const {
    switch (place_) {
      case Place::kTop:
        refuse("", fmt::format("is {}, not an object", found));
      case Place::kRoot:
        refuse(key_,
               fmt::format("is {}, not {}", found, key_ == "version" ? "a number" : "an array"));
      case Place::kList:
        refuse(objectName(), fmt::format("is {}, not an object", found));
      case Place::kVector:
        refuse(fieldName(), fmt::format("holds {}, not three numbers", found));
      default:
        refuse(fieldName(), fmt::format("is {}, not {}", found,
                                        isText(field())              ? "a text"
                                        : componentsOf(field()) == 1 ? "a number"
                                                                     : "an array of 3 numbers"));
    }
  }

  Objects objects_;
  const Object blank_;
  Object object_;
  std::vector<bool> given_;  // fields of object_
  Place place_ = Place::kTop;
  std::string key_;
  size_t index_ = 0;  // index of the current field
  size_t count_ = 0;  // numbers read of the current vector
  bool hasVersion_ = false;
  bool hasList_ = false;
};

Objects parsed(const Table& table, std::string_view text) {
  Reader reader(table);
  json::sax_parse(text.begin(), text.end(), &reader);
  return reader.take();
}

template <typename T>
void putDigits(std::string& text, T value) {
  std::array<char, 32> digits;
  text.append(digits.data(), fmt::format_to(digits.data(), "{}", value));
}

// Writes the fewest digits that read back as the same float. If reading them as a double and then
// rounding gives another float, writes the digits of the double.
void putNumber(std::string& text, const Field& field, double value) {
  const bool isFloat =
      field.type == GRISAILLE_FIELD_COLOUR || field.type == GRISAILLE_FIELD_DIRECTION;
  if (isFloat) {
    const auto single = static_cast<float>(value);
    const size_t before = text.size();
    putDigits(text, single);
    double read = 0;
    std::from_chars(text.data() + before, text.data() + text.size(), read);
    if (static_cast<float>(read) == single) return;
    text.resize(before);
  }
  putDigits(text, value);
}

void putNumbers(std::string& text, const Field& field, const std::array<double, 3>& numbers) {
  const size_t count = componentsOf(field);
  if (count == 3) text += '[';
  for (size_t i = 0; i < count; ++i) {
    if (i > 0) text += ", ";
    putNumber(text, field, numbers[i]);
  }
  if (count == 3) text += ']';
}

// `defaults`: an object of default values.
void putObject(std::string& text, const View& objects, size_t index, const Object& defaults) {
  bool first = true;
  text += '{';
  for (size_t i = 0; i < defaults.values.size(); ++i) {
    const Field& field = objects.table->fields[i];
    const Value& usual = defaults.values[i];
    const bool required = (field.flags & GRISAILLE_FIELD_REQUIRED) != 0;
    const size_t before = text.size();
    text += first ? "\"" : ", \"";
    text += field.key;
    text += "\": ";
    bool omitted = false;
    if (isText(field)) {
      const std::string own = objects.value(index, field).text;
      omitted = !required && own == usual.text;
      if (!omitted) text += json(own).dump();
    } else {
      const std::array<double, 3> own = objects.numbers(index, field);
      omitted = !required && own == usual.numbers;
      if (!omitted) putNumbers(text, field, own);
    }
    if (omitted) text.resize(before);
    first = first && omitted;
  }
  text += '}';
}

}  // namespace

void checkEnding(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  if (ending == ".json") return;
  throw Error(ErrorId::kObjectFileEnding, "{}: the ending \"{}\" is not .json", path, ending);
}

std::string jsonOf(const View& objects) {
  std::string text = fmt::format("{{\"version\": {}, \"{}\": [", kVersion, objects.table->key);
  const Object defaults(*objects.table);
  for (size_t i = 0; i < objects.count; ++i) {
    text += i == 0 ? "\n" : ",\n";
    putObject(text, objects, i, defaults);
  }
  text += "\n]}\n";
  return text;
}

void save(const View& objects, const std::string& path) {
  checkEnding(path);
  writeFileAtomically(path, jsonOf(objects));
}

Objects load(const Table& table, const std::string& path) {
  std::ifstream file = openRegularFile(path, ErrorId::kObjectFileUnreadable);
  std::error_code failed;
  const uintmax_t bytes = std::filesystem::file_size(path, failed);
  if (!failed) {
    if (std::optional<Objects> plain = readPlainFile(table, file, bytes)) return std::move(*plain);
  }
  return parse(table, readRegularFile(path, ErrorId::kObjectFileUnreadable), path);
}

Objects parse(const Table& table, std::string_view text, const std::string& name) {
  if (std::optional<Objects> plain = readPlainFile(table, text)) return std::move(*plain);
  try {
    return parsed(table, text);
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", name, error.detail());
  }
}

std::string listKeyOf(const std::string& path) {
  std::ifstream file = openRegularFile(path, ErrorId::kObjectFileUnreadable);
  std::string head(256, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  for (size_t at = head.find('"'); at != std::string::npos; at = head.find('"', at + 1)) {
    const size_t end = head.find('"', at + 1);
    const size_t colon =
        end == std::string::npos ? end : head.find_first_not_of(" \t\n\r", end + 1);
    if (colon == std::string::npos || head[colon] != ':') return "";
    std::string key = head.substr(at + 1, end - at - 1);
    if (key != "version") return key;
    at = end;
  }
  return "";
}

Object parseObject(const Table& table, std::string_view text) {
  try {
    const std::string file =
        fmt::format("{{\"version\": {}, \"{}\": [{}]}}", kVersion, table.key, text);
    const Objects objects = parsed(table, file);
    if (objects.size() == 1) return objects.view().object(0);
    throw Error(ErrorId::kObjectField, "there are {} objects, not one", objects.size());
  } catch (const Error& error) {
    throw Error(ErrorId::kObjectField, "{}", error.detail());
  }
}

}  // namespace grisaille::objects
