// SPDX-License-Identifier: MIT
#include "app/settings/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/nearest.h"

namespace grisaille::app {
namespace {

// The node's number; NaN if it is not a number.
double numberOf(const toml::node& node) {
  if (const auto* value = node.as_integer()) return static_cast<double>(value->get());
  if (const auto* value = node.as_floating_point()) return value->get();
  return std::nan("");
}

}  // namespace

std::string TomlTable::placeOf(const toml::node& node) const {
  return fmt::format("{}:{}", file_, node.source().begin.line);
}

void TomlTable::refuse(const toml::node& node, const std::string& why) const {
  throw Error(ErrorId::kSettingsInvalid, "{}: {}", placeOf(node), why);
}

const toml::node* TomlTable::find(const std::string& key) {
  known_.push_back(key);
  return table_.get(key);
}

const toml::node& TomlTable::require(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) refuse(table_, fmt::format("'{}' is missing", key));
  return *node;
}

std::string TomlTable::text(const std::string& key, const std::optional<std::string>& fallback) {
  const toml::node* node = fallback ? find(key) : &require(key);
  if (node == nullptr) return *fallback;
  const auto* value = node->as_string();
  if (value == nullptr) refuse(*node, fmt::format("'{}' is not a string", key));
  return value->get();
}

double TomlTable::number(const std::string& key, double fallback, double low, double high) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const double value = numberOf(*node);
  if (!(value >= low && value <= high)) {
    refuse(*node, fmt::format("'{}' is not a number from {} to {}", key, low, high));
  }
  return value;
}

uint32_t TomlTable::whole(const std::string& key, uint32_t fallback, uint32_t low, uint32_t high) {
  const double value = number(key, fallback, low, high);
  if (value != std::floor(value)) {
    refuse(*table_.get(key), fmt::format("'{}' is not a whole number", key));
  }
  return static_cast<uint32_t>(value);
}

bool TomlTable::flag(const std::string& key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const auto* value = node->as_boolean();
  if (value == nullptr) refuse(*node, fmt::format("'{}' is not true or false", key));
  return value->get();
}

std::vector<std::string> TomlTable::texts(const std::string& key) {
  std::vector<std::string> result;
  const toml::node* node = find(key);
  if (node == nullptr) return result;
  const toml::array* array = node->as_array();
  for (size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const auto* value = array->get(i)->as_string();
    if (value == nullptr)
      refuse(*array->get(i), fmt::format("'{}' has an element that is not a string", key));
    result.push_back(value->get());
  }
  if (array == nullptr) refuse(*node, fmt::format("'{}' is not an array of strings", key));
  return result;
}

std::vector<double> TomlTable::numbers(const std::string& key, size_t count) {
  std::vector<double> result;
  const toml::node* node = find(key);
  if (node == nullptr) return result;
  const toml::array* array = node->as_array();
  for (size_t i = 0; array != nullptr && i < array->size(); ++i) {
    result.push_back(numberOf(*array->get(i)));
  }
  const bool good = result.size() == count &&
                    std::ranges::all_of(result, [](double value) { return std::isfinite(value); });
  if (!good) refuse(*node, fmt::format("'{}' is not an array of {} numbers", key, count));
  return result;
}

std::vector<const toml::table*> TomlTable::tables(const std::string& key) {
  const toml::node& node = require(key);
  if (const toml::table* one = node.as_table()) return {one};
  std::vector<const toml::table*> result;
  const toml::array* array = node.as_array();
  for (size_t i = 0; array != nullptr && i < array->size(); ++i) {
    result.push_back(array->get(i)->as_table());
    if (result.back() == nullptr) {
      refuse(*array->get(i), fmt::format("'{}' has an element that is not a table", key));
    }
  }
  if (result.empty()) refuse(node, fmt::format("'{}' is not a table or an array of tables", key));
  return result;
}

void TomlTable::finish() const {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (std::ranges::find(known_, name) != known_.end()) continue;
    const std::string near = nearest(name, known_);
    refuse(node, fmt::format("'{}' is not a key here{}{}", name,
                             near.empty() ? "" : ", nearest is ", near));
  }
}

}  // namespace grisaille::app
