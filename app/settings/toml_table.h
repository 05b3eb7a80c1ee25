// SPDX-License-Identifier: MIT
// Reads a table of a TOML file key by key. Its errors start with file:line.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grisaille::app {

class TomlTable {
 public:
  // `file` is for messages. `table` must outlive this object.
  TomlTable(std::string file, const toml::table& table) : file_(std::move(file)), table_(table) {}

  const std::string& file() const { return file_; }
  std::string place() const { return placeOf(table_); }
  std::string placeOf(const toml::node& node) const;

  // Null if the table has no such key. finish() refuses all keys that were never looked up.
  const toml::node* find(const std::string& key);
  // Throws kSettingsInvalid.
  const toml::node& require(const std::string& key);

  // The key's value, or `fallback` without the key. Without a fallback text() requires the key.
  // Throws kSettingsInvalid for other types and for numbers outside low ... high.
  std::string text(const std::string& key, const std::optional<std::string>& fallback = {});
  double number(const std::string& key, double fallback, double low, double high);
  uint32_t whole(const std::string& key, uint32_t fallback, uint32_t low, uint32_t high);
  bool flag(const std::string& key, bool fallback);
  std::vector<std::string> texts(const std::string& key);             // {}: no such key
  std::vector<double> numbers(const std::string& key, size_t count);  // {}: no such key

  // The tables of an array, or a single table. Throws kSettingsInvalid.
  std::vector<const toml::table*> tables(const std::string& key);

  // Throws kSettingsInvalid if the table has a key that was never looked up; the message suggests
  // the nearest known key.
  void finish() const;

  // Throws kSettingsInvalid, with the node's place before `why`.
  [[noreturn]] void refuse(const toml::node& node, const std::string& why) const;

 private:
  std::string file_;
  const toml::table& table_;
  std::vector<std::string> known_;
};

}  // namespace grisaille::app
