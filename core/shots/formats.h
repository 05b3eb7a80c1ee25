// SPDX-License-Identifier: MIT
// The two formats of shot_file.h, on streams. What they throw names no file.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::shots {

// What a binary file begins with, and no JSON text can.
constexpr unsigned char kBinaryMark = 0x89;

// The stream's state tells whether all was written.
void writeBinary(std::span<const grisaille_shot> shots, std::ostream& out);
void writeJson(std::span<const grisaille_shot> shots, std::ostream& out);

// `bytes`: the size of the whole file.
std::vector<grisaille_shot> readBinary(std::istream& in, uint64_t bytes);
std::vector<grisaille_shot> readJson(std::istream& in);

}  // namespace grisaille::shots
