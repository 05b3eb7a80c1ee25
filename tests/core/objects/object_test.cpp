// SPDX-License-Identifier: MIT
// Object fields of every type: accepted values, and their form in a list.
#include "core/objects/object.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <limits>

#include "tests/core/objects/random_objects.h"
#include "tests/support/expect_error.h"

namespace grisaille::objects {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Value numbers(double x, double y = 0, double z = 0) {
  return {.numbers = {x, y, z}, .text = {}};
}
Value words(std::string text) {
  return {.numbers = {}, .text = std::move(text)};
}

// The detail of the error that checked() throws.
std::string refusal(const Field& field, const Value& value) {
  try {
    checked(field, value);
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kObjectField);
    return error.detail();
  }
  ADD_FAILURE() << field.key << " was accepted";
  return "";
}

TEST(ObjectFields, NumbersThatDoNotFitAreNamedByComponent) {
  for (size_t i = 0; i < 3; ++i) {
    const auto named = [i](size_t field, double bad) {
      Value value = defaultOf(kDecalFields[field]);
      value.numbers[i] = bad;
      const std::string why = refusal(kDecalFields[field], value);
      EXPECT_TRUE(why.starts_with(fmt::format("{}[{}] is ", kDecalFields[field].key, i))) << why;
    };
    for (const double bad : {kNan, kInfinity, -kInfinity, 1.0000001e9, -1e300})
      named(kPosition, bad);
    for (const double bad : {kNan, kInfinity, -kInfinity}) named(kDirection, bad);
    for (const double bad : {kNan, kInfinity, -1e-9, 1.000000001, -DBL_MIN}) named(kColour, bad);
  }
  for (const double bad : {kNan, kInfinity, -kInfinity, -1.0000001, 1.0000001e6}) {
    EXPECT_TRUE(refusal(kDecalFields[kSize], numbers(bad)).starts_with("size is "));
  }
  EXPECT_TRUE(refusal(kDecalFields[kDirection], numbers(0, -0.0, 0)).starts_with("direction "));
}

TEST(ObjectFields, LimitsBelong) {
  EXPECT_NO_THROW(checked(kDecalFields[kPosition], numbers(1e9, -1e9, -0.0)));
  EXPECT_NO_THROW(checked(kDecalFields[kColour], numbers(0, 1, -0.0)));
  for (const double size : {-1.0, 0.0, -0.0, DBL_MIN, kLargestSize}) {
    EXPECT_NO_THROW(checked(kDecalFields[kSize], numbers(size)));
  }
}

TEST(ObjectFields, TextsAreOneLineOfUtf8) {
  for (const size_t text : {kNote, kPicture}) {
    const Field& field = kDecalFields[text];
    for (const std::string& good :
         {std::string(), std::string("a b"), std::string("\xc3\xa9\xf0\x9f\x8e\xa8"),
          std::string(kLongestText, 'x')}) {
      EXPECT_EQ(checked(field, words(good)).text, good);
    }
    EXPECT_NE(refusal(field, words(std::string(kLongestText + 1, 'x'))).find("4097 bytes"),
              std::string::npos);
    for (const std::string& bad : {std::string("a\nb"), std::string("\t"), std::string("\x7f"),
                                   std::string("a\0b", 3), std::string("\x1b[2J")}) {
      EXPECT_NE(refusal(field, words(bad)).find("control character"), std::string::npos);
    }
    for (const char* bad : {"\xff", "a\xc3", "\xed\xa0\x80"}) {
      EXPECT_NE(refusal(field, words(bad)).find("UTF-8"), std::string::npos);
    }
  }
}

TEST(ObjectFields, DirectionsOfAnyLengthComeOutUnit) {
  const Field& field = kDecalFields[kDirection];
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double length :
       {5e-324, 1e-320, 1e-300, 1e-160, 1e-20, 1.0, 1e20, 1e160, 1e300, 1.79e308}) {
    // Along an axis, even the smallest double has a direction.
    for (size_t axis = 0; axis < 3; ++axis) {
      Value value;
      value.numbers[axis] = -length;
      EXPECT_EQ(checked(field, value).numbers[axis], -1) << length;
    }
    if (length < 1e-300) continue;  // denormals are too coarse for the checks below
    for (int i = 0; i < 1000; ++i) {
      std::array<double, 3> unit{normal(random), normal(random), normal(random)};
      const double size = std::hypot(unit[0], unit[1], unit[2]);
      Value value;
      for (size_t k = 0; k < 3; ++k) value.numbers[k] = (unit[k] /= size) * length;
      const Value made = checked(field, value);
      for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(made.numbers[k], unit[k], 1e-7) << length;
    }
  }
}

// Checking a value that comes from a list changes no bit of it.
TEST(ObjectFields, CheckingWhatIsCheckedChangesNothing) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    Objects once(kDecals), twice(kDecals);
    once.append(randomObject(random));
    twice.append(once.view().object(0));
    ASSERT_TRUE(sameObjects(once.view(), twice.view())) << i;
  }
}

TEST(ObjectFields, TextsOfValuesReadBack) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 5000; ++i) {
    const Objects one = randomObjects(random, 1);
    for (const Field& field : kDecalFields) {
      const Value value = one.view().value(0, field);
      const std::string text = textOf(field, value);
      const Value back = parseValue(field, text);
      if (field.type == GRISAILLE_FIELD_COLOUR) {
        // Rounding happens once: converting the text again gives the same text.
        EXPECT_EQ(textOf(field, back), text);
        for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(back.numbers[k], value.numbers[k], 0.005);
      } else {
        EXPECT_EQ(back, value) << field.key << " " << text;
      }
    }
  }
}

TEST(ObjectFields, ColoursAreSrgb) {
  const Field& field = kDecalFields[kColour];
  EXPECT_EQ(parseValue(field, "#000000"), numbers(0, 0, 0));
  EXPECT_EQ(parseValue(field, "#ffFFff"), numbers(1, 1, 1));
  EXPECT_NEAR(parseValue(field, "#808080").numbers[1], 0.21586, 1e-5);
  for (int byte = 0; byte < 256; ++byte) {
    const std::string text = fmt::format("#{0:02x}{1:02x}{0:02x}", byte, 255 - byte);
    EXPECT_EQ(textOf(field, parseValue(field, text)), text);
  }
}

TEST(ObjectFields, WhatIsNoValueIsRefusedByKeyAndText) {
  const std::pair<size_t, std::vector<const char*>> cases[] = {
      {kPosition,
       {"", "1", "1:2", "1:2:3:4", "1:2:", ":1:2", "1::2", "1,2,3", "1:2:x", "1:2:3 ", " 1:2:3",
        "+1:2:3", "1e999:0:0", "0x1:0:0"}},
      {kDirection, {"0:0", "a:b:c"}},
      {kColour,
       {"", "#", "#fff", "#ff80000", "ff8000", "#gg0000", "#-12345", "#+12345", "1:0:0",
        "#ff800 "}},
      {kSize, {"", " ", "x", "1 ", "1:2", "1e999"}}};
  for (const auto& [index, texts] : cases) {
    const Field& field = kDecalFields[index];
    for (const char* text : texts) {
      try {
        parseValue(field, text);
        ADD_FAILURE() << field.key << " took '" << text << "'";
      } catch (const Error& error) {
        EXPECT_EQ(error.id(), ErrorId::kObjectField);
        EXPECT_TRUE(error.detail().starts_with(fmt::format("{} is '{}', not ", field.key, text)))
            << error.what();
      }
    }
  }
  for (const auto& [index, text] : {std::pair{kPosition, "1e10:0:0"},
                                    {kPosition, "nan:0:0"},
                                    {kDirection, "0:0:0"},
                                    {kSize, "1e7"},
                                    {kSize, "inf"}}) {
    EXPECT_ERROR(ErrorId::kObjectField, parseValue(kDecalFields[index], text));
  }
}

TEST(ObjectFields, UnknownKeysNameTheNearestAndAllThatThereAre) {
  EXPECT_EQ(&fieldOf(kDecals, "colour"), &kDecalFields[kColour]);
  try {
    fieldOf(kDecals, "color");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kObjectField);
    EXPECT_EQ(error.detail(),
              "there is no field \"color\", nearest is colour; decals have position, direction, "
              "colour, size, note, picture");
  }
  Object object(kDecals);
  object.at(kDecals, "size").numbers[0] = 3;
  EXPECT_EQ(object.values[kSize].numbers[0], 3);
  EXPECT_ERROR(ErrorId::kObjectField, object.at(kDecals, ""));
}

// --- Lists

TEST(Objects, LieInMemoryAsTheTableSays) {
  std::mt19937_64 random(4);
  const Objects objects = randomObjects(random, 50);
  const auto* decals = reinterpret_cast<const Decal*>(objects.view().data);
  for (size_t i = 0; i < 50; ++i) {
    const Object object = objects.view().object(i);
    const Decal& decal = decals[i];
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(decal.position[k], object.values[kPosition].numbers[k]);
      EXPECT_EQ(decal.direction[k], object.values[kDirection].numbers[k]);
      EXPECT_EQ(decal.colour[k], object.values[kColour].numbers[k]);
    }
    EXPECT_EQ(decal.size, object.values[kSize].numbers[0]);
    EXPECT_EQ(decal.note, object.values[kNote].text);
    EXPECT_EQ(decal.picture, object.values[kPicture].text);
  }
}

TEST(Objects, HoldNoNegativeZero) {
  Objects objects(kDecals);
  Object object(kDecals);
  object.values[kPosition].numbers = {-0.0, 1, 2};
  object.values[kDirection].numbers = {-1, 0, 1e300};  // -1e-300 as a float is -0
  object.values[kColour].numbers = {-0.0, 0, 0};
  objects.append(object);
  for (const size_t field : {kPosition, kDirection, kColour}) {
    EXPECT_FALSE(std::signbit(objects.view().numbers(0, kDecalFields[field])[0])) << field;
  }
}

TEST(Objects, ARefusalNamesObjectAndFieldAndAppendsNothing) {
  std::mt19937_64 random(5);
  Objects objects = randomObjects(random, 3);
  Object bad = randomObject(random);
  bad.values[kColour].numbers = {0, 2, 0};
  const auto words = [&](auto&& append) {
    try {
      append();
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kObjectField);
      return error.detail();
    }
    return std::string();
  };
  EXPECT_EQ(words([&] { objects.append(bad); }), "decals[3].colour[1] is 2, out of 0 to 1");
  EXPECT_EQ(words([&] { objects.append(bad, "it"); }), "it.colour[1] is 2, out of 0 to 1");
  // Structs as a host hands them over; the second is invalid.
  std::vector<Decal> raw(3, {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 1, "", ""});
  raw[1].direction[2] = 0;
  const View given{&kDecals, reinterpret_cast<const std::byte*>(raw.data()), raw.size()};
  EXPECT_TRUE(
      words([&] { objects.append(given); }).starts_with("decals[4].direction has no length"));
  EXPECT_EQ(objects.size(), 3u);
  Objects later(kDecals, 100);
  EXPECT_TRUE(words([&] { later.append(bad); }).starts_with("decals[100].colour[1]"));
}

TEST(Objects, TextsLiveAsLongAsTheObjects) {
  std::mt19937_64 random(6);
  Objects copy(kDecals);
  std::vector<Object> expected;
  {
    Objects objects = randomObjects(random, 40);
    for (size_t i = 0; i < 40; ++i) expected.push_back(objects.view().object(i));
    copy = objects;
    Objects moved = std::move(objects);
    EXPECT_TRUE(sameObjects(moved.view(), copy.view()));
  }
  for (size_t i = 0; i < 40; ++i) EXPECT_EQ(copy.view().object(i), expected[i]);
}

TEST(Objects, ANullTextOfAHostIsEmpty) {
  const Decal decal = {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, 1, nullptr, nullptr};
  Objects objects(kDecals);
  objects.append(View{&kDecals, reinterpret_cast<const std::byte*>(&decal), 1});
  EXPECT_EQ(objects.view().value(0, kDecalFields[kNote]).text, "");
  EXPECT_STREQ(reinterpret_cast<const Decal*>(objects.view().data)->note, "");
}

}  // namespace
}  // namespace grisaille::objects
