// SPDX-License-Identifier: MIT
// A table of a TOML file, read key by key; what is wrong is said with file:line.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grisaille::lab::claims {

class TomlTable {
 public:
  // `file` is for messages; `table` outlives this.
  TomlTable(std::string file, const toml::table& table) : file_(std::move(file)), table_(table) {}

  const std::string& file() const { return file_; }
  std::string place() const { return placeOf(table_); }
  std::string placeOf(const toml::node& node) const;

  // Null: there is none. A key that was never asked for is refused by finish().
  const toml::node* find(const std::string& key);
  // Throws kSettingsInvalid.
  const toml::node& require(const std::string& key);

  // The key's value, or `fallback` where there is none. Throws kSettingsInvalid for other types.
  std::string text(const std::string& key, const std::optional<std::string>& fallback = {});
  double number(const std::string& key, double fallback, double low, double high);
  uint32_t whole(const std::string& key, uint32_t fallback, uint32_t low, uint32_t high);
  std::vector<std::string> texts(const std::string& key);             // {}: no such key
  std::vector<double> numbers(const std::string& key, size_t count);  // {}: no such key

  // The tables of an array, or a table alone. Throws kSettingsInvalid.
  std::vector<const toml::table*> tables(const std::string& key);

  // Throws kSettingsInvalid where the table has a key that was not asked for, with the nearest one.
  void finish() const;

  // Throws kSettingsInvalid.
  [[noreturn]] void refuse(const toml::node& node, const std::string& why) const;

 private:
  std::string file_;
  const toml::table& table_;
  std::vector<std::string> known_;
};

}  // namespace grisaille::lab::claims
