// SPDX-License-Identifier: MIT
#include "core/objects/own_table.h"

namespace grisaille::objects {

OwnTable::OwnTable(const Table& from)
    : fields_(fieldsOf(from).begin(), fieldsOf(from).end()), table_(from) {
  texts_.reserve(3 + 5 * fields_.size());  // texts must not move
  for (const char** text : {&table_.key, &table_.label, &table_.tooltip}) *text = keep(*text);
  for (Field& field : fields_) {
    for (const char** text :
         {&field.key, &field.label, &field.unit, &field.tooltip, &field.default_text}) {
      *text = keep(*text);
    }
  }
  table_.fields = fields_.data();
}

const char* OwnTable::keep(const char* text) {
  return text == nullptr ? nullptr : texts_.emplace_back(text).c_str();
}

}  // namespace grisaille::objects
