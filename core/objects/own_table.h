// SPDX-License-Identifier: MIT
// A copy of an effect's table of objects that outlives the plugin, for a list that does.
#pragma once

#include <string>
#include <vector>

#include "core/objects/object.h"

namespace grisaille::objects {

class OwnTable {
 public:
  // Copies the table with its fields and texts.
  explicit OwnTable(const Table& from);
  OwnTable(const OwnTable&) = delete;
  OwnTable& operator=(const OwnTable&) = delete;

  const Table& table() const { return table_; }

 private:
  const char* keep(const char* text);  // null stays null

  std::vector<std::string> texts_;
  std::vector<Field> fields_;
  Table table_;
};

}  // namespace grisaille::objects
