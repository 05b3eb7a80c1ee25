// SPDX-License-Identifier: MIT
// A table with fields of every type, and random objects of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/objects/object.h"
#include "grisaille/effect.hpp"

namespace grisaille::objects {

struct Decal {
  double position[3];
  float direction[3];
  float colour[3];
  double size;
  const char* note;
  const char* picture;
};

enum DecalField : size_t { kPosition, kDirection, kColour, kSize, kNote, kPicture };

constexpr double kLargestSize = 1e6;

constexpr Field kDecalFields[] = {plugin::field({.key = "position",
                                                 .label = "Position",
                                                 .tooltip = "Where it is",
                                                 .type = GRISAILLE_FIELD_POINT,
                                                 .offset = offsetof(Decal, position),
                                                 .required = true}),
                                  plugin::field({.key = "direction",
                                                 .label = "Direction",
                                                 .tooltip = "Where it looks",
                                                 .type = GRISAILLE_FIELD_DIRECTION,
                                                 .offset = offsetof(Decal, direction),
                                                 .defaults = {0, 0, -1},
                                                 .required = true}),
                                  plugin::field({.key = "colour",
                                                 .label = "Colour",
                                                 .tooltip = "Linear",
                                                 .type = GRISAILLE_FIELD_COLOUR,
                                                 .offset = offsetof(Decal, colour),
                                                 .defaults = {1, 0.08f, 0.004f}}),
                                  plugin::field({.key = "size",
                                                 .label = "Size",
                                                 .unit = "m",
                                                 .tooltip = "How large",
                                                 .type = GRISAILLE_FIELD_NUMBER,
                                                 .offset = offsetof(Decal, size),
                                                 .min = -1,
                                                 .max = kLargestSize,
                                                 .defaults = {0.1}}),
                                  plugin::field({.key = "note",
                                                 .label = "Note",
                                                 .tooltip = "Any words",
                                                 .type = GRISAILLE_FIELD_TEXT,
                                                 .offset = offsetof(Decal, note),
                                                 .text = "none"}),
                                  plugin::field({.key = "picture",
                                                 .label = "Picture",
                                                 .tooltip = "Which file",
                                                 .type = GRISAILLE_FIELD_FILE,
                                                 .offset = offsetof(Decal, picture),
                                                 .text = ""})};

constexpr Table kDecals = plugin::objects<Decal>({.key = "decals",
                                                  .label = "Decals",
                                                  .tooltip = "Pictures on surfaces",
                                                  .fields = kDecalFields,
                                                  .placement = GRISAILLE_PLACE_SURFACE,
                                                  .pointField = kPosition,
                                                  .directionField = kDirection});

// The same fields without texts, for objects whose structs hold no pointers.
constexpr Table kPlainDecals = plugin::objects<Decal>({.key = "decals",
                                                       .label = "Decals",
                                                       .tooltip = "Colours on surfaces",
                                                       .fields = std::span(kDecalFields).first(4),
                                                       .pointField = kPosition,
                                                       .directionField = kDirection});

// Random numbers up to `largest`, of any magnitude and sign; 0 and -0 occur.
inline double anySize(std::mt19937_64& random, double largest) {
  std::uniform_real_distribution<double> share(-1, 1);
  const double value = largest * share(random);
  switch (random() % 8) {
    case 0:
      return std::copysign(0.0, value);
    case 1:
      return std::copysign(largest, value);
    case 2:
      return value;
    default:
      return value * std::exp2(-std::abs(share(random)) * 120);
  }
}

// Text of characters of one to four bytes, including those that JSON escapes.
inline std::string anyText(std::mt19937_64& random) {
  constexpr const char* kCharacters[] = {
      "a",        "Z",  " ", "\"", "\\",           "/",
      "\xc3\xa9", "\'", "{", "]",  "\xe2\x82\xac", "\xf0\x9f\x8e\xa8",
      ",",        ":"};
  std::string text;
  for (size_t n = random() % 12; n > 0; --n) text += kCharacters[random() % std::size(kCharacters)];
  return text;
}

inline Object randomObject(std::mt19937_64& random, const Table& table = kDecals) {
  Object object(table);
  for (double& x : object.values[kPosition].numbers) x = anySize(random, kFarthestPoint);
  for (double& x : object.values[kDirection].numbers) x = anySize(random, 1e300);
  object.values[kDirection].numbers[random() % 3] = anySize(random, 1) + 3;
  for (double& x : object.values[kColour].numbers) x = std::abs(anySize(random, 1));
  if (random() % 2 == 0) object.values[kColour] = defaultOf(table.fields[kColour]);
  if (random() % 2 == 0) object.values[kSize].numbers[0] = std::abs(anySize(random, kLargestSize));
  for (size_t text = kNote; text < object.values.size(); ++text) {
    if (random() % 2 == 0) object.values[text].text = anyText(random);
  }
  return object;
}

inline Objects randomObjects(std::mt19937_64& random, size_t count, const Table& table = kDecals) {
  Objects objects(table);
  for (size_t i = 0; i < count; ++i) objects.append(randomObject(random, table));
  return objects;
}

// Whether all numbers are bitwise equal. Lists hold no -0.
inline bool sameValue(const Value& a, const Value& b) {
  return a == b &&
         !std::ranges::any_of(a.numbers, [](double x) { return x == 0 && std::signbit(x); });
}

inline bool sameObjects(const View& a, const View& b) {
  if (a.count != b.count || a.table->field_count != b.table->field_count) return false;
  for (size_t i = 0; i < a.count; ++i) {
    for (size_t f = 0; f < a.table->field_count; ++f) {
      if (!sameValue(a.value(i, a.table->fields[f]), b.value(i, b.table->fields[f]))) return false;
    }
  }
  return true;
}

}  // namespace grisaille::objects
