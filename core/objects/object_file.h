// SPDX-License-Identifier: MIT
// Objects in JSON files. The members of an object may stand in any order; unknown ones are refused.
// Saving and loading bring back every bit.
//
//   {"version": 1, "decals": [            the list's key in the effect's table
//     {"position": [x, y, z],             a point or a direction: three numbers
//      "colour": [r, g, b],               linear, each 0 to 1
//      "size": 0.5,                       a number
//      "picture": "moss.png"}             a text or a file
//   ]}
//
// A field that the table does not require may be left out: it has its default then.
#pragma once

#include <string>
#include <string_view>

#include "core/objects/object.h"

namespace grisaille::objects {

// Throws kObjectFileEnding unless the path ends in .json.
void checkEnding(const std::string& path);

// The text of a file.
std::string jsonOf(const View& objects);

// An older file stays as it was, whatever fails. Throws kObjectFileEnding and kFileUnwritable.
void save(const View& objects, const std::string& path);

// Oldest first. Throws kObjectFileUnreadable; kObjectFileVersion; kObjectFileInvalid, which names
// the line of a fault of JSON, or object and field: "decals[3].colour[1] is 2, out of 0 to
// 1".
Objects load(const Table& table, const std::string& path);

// The key of the list that a file holds: the first member of its beginning that is no version. "":
// it has none there, or is no such file. Throws kObjectFileUnreadable.
std::string listKeyOf(const std::string& path);

// One object as it stands in a file: {"position": [x, y, z], ...}. Throws kObjectField.
Object parseObject(const Table& table, std::string_view json);

}  // namespace grisaille::objects
