// SPDX-License-Identifier: MIT
// Objects in JSON files. The members of an object may have any order; unknown members are refused.
// Saving and loading is lossless, to the last bit.
//
//   {"version": 1, "decals": [            the list's key in the effect's table
//     {"position": [x, y, z],             a point or a direction: three numbers
//      "colour": [r, g, b],               linear, each 0 to 1
//      "size": 0.5,                       a number
//      "picture": "moss.png"}             a text or a file
//   ]}
//
// A file may omit a field that the table does not require; the field then has its default.
#pragma once

#include <string>
#include <string_view>

#include "core/objects/object.h"

namespace grisaille::objects {

// Throws kObjectFileEnding unless the path ends in .json.
void checkEnding(const std::string& path);

// The text of the file that save() writes.
std::string jsonOf(const View& objects);

// Writes atomically: if it fails, an older file stays unchanged. Throws kObjectFileEnding and
// kFileUnwritable.
void save(const View& objects, const std::string& path);

// Loads objects, oldest first. Throws kObjectFileUnreadable; kObjectFileVersion;
// kObjectFileInvalid, which names the line of a JSON error, or object and field:
// "decals[3].colour[1] is 2, out of 0 to 1".
Objects load(const Table& table, const std::string& path);

// The same from the text of a file; `name` prefixes the messages.
Objects parse(const Table& table, std::string_view text, const std::string& name);

// The key of the list in a file: the first member, in the file's first 256 bytes, other than
// "version". "" if no such member exists. Throws kObjectFileUnreadable.
std::string listKeyOf(const std::string& path);

// Parses one object in the form of the file: {"position": [x, y, z], ...}. Throws kObjectField.
Object parseObject(const Table& table, std::string_view json);

}  // namespace grisaille::objects
