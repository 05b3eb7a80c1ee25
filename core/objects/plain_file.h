// SPDX-License-Identifier: MIT
// A fast reader for object files in the form that save() writes.
#pragma once

#include <istream>
#include <optional>
#include <string_view>

#include "core/objects/object.h"

namespace grisaille::objects {

// Reads a file whose first member is the version and whose second is the list, without escape
// sequences. White space and the order of an object's fields are free. Returns nullopt for any
// other file, whether it is valid or not: the reader of load() reads every valid file and names
// every fault, but takes several times as long.
std::optional<Objects> readPlainFile(const Table& table, std::string_view text);

// The same for an open file of `bytes` bytes, of which it holds a few MiB in memory at a time.
std::optional<Objects> readPlainFile(const Table& table, std::istream& file, uintmax_t bytes);

}  // namespace grisaille::objects
