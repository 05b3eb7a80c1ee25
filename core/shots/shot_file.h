// SPDX-License-Identifier: MIT
// Shots in files: JSON for people and programs, a binary form for a million. Both bring back every
// bit of what was saved.
//
// JSON (.json). The members of an object may stand in any order; others than these are refused.
//
//   {"version": 1, "shots": [
//     {"origin": [x, y, z],     world, metres, within 1e9 on each axis
//      "direction": [x, y, z],  world, of any length over 0
//      "color": [r, g, b],      linear, each 0 to 1
//      "range": r}              metres, up to 1e6; without it or 0: as the effect's parameter says
//   ]}
//
// Binary (.shots). Numbers are little-endian, floating point is IEEE 754.
//
//    byte        bytes
//    0           8       89 47 52 53 48 0D 0A 1A (hexadecimal)
//    8           4       version, 1
//    12          8       n, the number of shots
//    20          52 n    the shots, oldest first
//    20 + 52 n   8       FNV-1a, 64 bits, of all bytes before
//
//   and of a shot:
//
//    0           24      origin, three doubles
//    24          12      direction, three floats
//    36          12      color, three floats
//    48          4       range, a float; 0: as the effect's parameter says
#pragma once

#include <span>
#include <string>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::shots {

// Throws kShotFileEnding unless save() can tell the format by the ending.
void checkEnding(const std::string& path);

// The ending of `path` tells the format. Whatever fails, an older file stays as it was. Throws
// kShotFileEnding and kFileUnwritable, and as makeShot() does.
void save(std::span<const grisaille_shot> shots, const std::string& path);

// The content tells the format. The shots are as makeShot() leaves them, oldest first. Throws
// kShotFileUnreadable; kShotFileVersion; kShotFileInvalid, which names line:column or byte.
std::vector<grisaille_shot> load(const std::string& path);

}  // namespace grisaille::shots
