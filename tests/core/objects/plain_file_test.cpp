// SPDX-License-Identifier: MIT
// The fast reader against the general one: it may read less, but never anything else.
#include "core/objects/plain_file.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.h"
#include "core/objects/object_file.h"
#include "tests/core/objects/random_objects.h"
#include "tests/support/folder_test.h"

namespace grisaille::objects {
namespace {

// Objects as the general reader reads them. Only it takes a byte order mark.
std::optional<Objects> readGenerally(const std::string& text) {
  try {
    return parse(kDecals, "\xEF\xBB\xBF" + text, "text");
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<Objects> readFromStream(const std::string& text) {
  std::istringstream file(text);
  return readPlainFile(kDecals, file, text.size());
}

bool readsTheSame(const std::string& text) {
  const std::optional<Objects> plain = readPlainFile(kDecals, text);
  if (!plain) return true;
  const std::optional<Objects> general = readGenerally(text);
  return general && sameObjects(plain->view(), general->view());
}

Objects withoutEscapes(std::mt19937_64& random, size_t count) {
  Objects objects(kDecals);
  for (size_t i = 0; i < count; ++i) {
    Object object = randomObject(random);
    std::erase_if(object.values[kNote].text, [](char c) { return c == '"' || c == '\\'; });
    std::erase_if(object.values[kPicture].text, [](char c) { return c == '"' || c == '\\'; });
    objects.append(object);
  }
  return objects;
}

// 60,000 objects are over twice as much as the reader holds in memory.
TEST(PlainFile, ReadsAllThatIsSaved) {
  for (const size_t count : {0, 1, 2, 37, 60000}) {
    std::mt19937_64 random(count);
    const Objects objects = withoutEscapes(random, count);
    const std::string text = jsonOf(objects.view());
    if (count == 60000) {
      ASSERT_GT(text.size(), size_t{9} << 20);
    }
    const std::optional<Objects> plain = readPlainFile(kDecals, text);
    ASSERT_TRUE(plain) << count;
    EXPECT_TRUE(sameObjects(plain->view(), objects.view())) << count;
    const std::optional<Objects> streamed = readFromStream(text);
    ASSERT_TRUE(streamed) << count;
    EXPECT_TRUE(sameObjects(streamed->view(), objects.view())) << count;
  }
}

TEST(PlainFile, AcceptsNothingThatTheGeneralReaderRefuses) {
  std::mt19937_64 random(3);
  const std::string whole = jsonOf(withoutEscapes(random, 2).view());
  for (int i = 0; i < 20000; ++i) {
    std::string damaged = whole;
    const size_t at = random() % damaged.size();
    switch (random() % 4) {
      case 0:
        damaged.erase(at, 1 + random() % 3);
        break;
      case 1:
        damaged.insert(at, 1, R"(0123456789.-+eE,:"{}[] \)"[random() % 24]);
        break;
      case 2:
        damaged[at] = R"(0123456789.-+eE,:"{}[] \)"[random() % 24];
        break;
      default:
        damaged[at] = static_cast<char>(random());
    }
    EXPECT_TRUE(readsTheSame(damaged)) << damaged;
  }
}

std::string withSize(const std::string& number) {
  return R"({"version": 1, "decals": [{"position": [0, 0, 0], "direction": [0, 0, 1], "size": )" +
         number + "}]}";
}

TEST(PlainFile, TakesTheNumbersOfJsonAlone) {
  for (const char* number : {"0", "-0", "-0.5", "7", "10", "0.25", "1.5e3", "1E+2", "1e-2", "0e0",
                             "0.1000000000000000055511151231257827", "123456.789"}) {
    EXPECT_TRUE(readPlainFile(kDecals, withSize(number))) << number;
    EXPECT_TRUE(readsTheSame(withSize(number))) << number;
  }
  for (const char* number :
       {"01",  "-01",   "00",  "1.",  "1.e3", ".5",  "-.5",      "+1",    "-",
        "1e",  "1e+",   "0x1", "inf", "-inf", "nan", "infinity", "1e400", "1_0",
        "1,5", "\"1\"", "[1]", "1 1", "",     "-2",  "1e7"}) {
    EXPECT_FALSE(readPlainFile(kDecals, withSize(number))) << number;
  }
}

TEST(PlainFile, LeavesTheRestToTheGeneralReader) {
  const std::string object = R"({"position": [0, 0, 0], "direction": [0, 0, 1]})";
  const std::string file = R"({"version": 1, "decals": [)" + object + "]}";
  EXPECT_TRUE(readPlainFile(kDecals, file));
  EXPECT_TRUE(readPlainFile(kDecals, "\t\r\n " + file + " \n"));
  for (const std::string& other : std::initializer_list<std::string>{
           file + "x", file + "]", "[" + file + "]", file.substr(1), R"({"version": 1})",
           R"({"decals": [], "version": 1})", R"({"version": 2, "decals": []})",
           R"({"version": 1, "shots": []})", R"({"version": 1, "decals": [{}]})",
           R"({"version": 1, "decals": [], "decals": []})",
           R"({"version": 1, "decals": [)" + object + ",]}",
           R"({"version": 1, "decals": [{"size": 1, "size": 1, )" + object.substr(1) + "]}",
           R"({"version": 1, "decals": [{"sise": 1, )" + object.substr(1) + "]}",
           R"({"version": 1, "decals": [{"note": "\u00e9", )" + object.substr(1) + "]}",
           "{\"version\": 1, \"decals\": [{\"note\": \"\xff\", " + object.substr(1) + "]}",
           "{\"version\": 1, \"decals\": [{\"note\": \"\n\", " + object.substr(1) + "]}"}) {
    EXPECT_FALSE(readPlainFile(kDecals, other)) << other;
  }
}

class PlainFiles : public tests::FolderTest {};

// White space may push an object over the end of the reader's memory.
TEST_F(PlainFiles, ALongGapIsReadAllTheSame) {
  const std::string object = R"({"position": [0, 0, 0], "direction": [0, 0, 1]})";
  for (const size_t gap : {size_t{1000}, size_t{5} << 20}) {
    std::string text = R"({"version": 1, "decals": [)" + object;
    for (int i = 0; i < 3; ++i) {
      text += ",{" + std::string(gap, ' ') + object.substr(1);
    }
    text += "]}";
    EXPECT_EQ(load(kDecals, fileOf("a.json", text)).size(), 4u) << gap;
  }
}

}  // namespace
}  // namespace grisaille::objects
