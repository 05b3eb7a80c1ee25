// SPDX-License-Identifier: MIT
// Object files that are truncated, corrupt or invalid.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/objects/object_file.h"
#include "tests/core/objects/random_objects.h"
#include "tests/support/folder_test.h"

namespace grisaille::objects {
namespace {

class DamagedObjects : public tests::FolderTest {
 protected:
  // Loads `content`. Returns the error's detail after the path, or "" if loading succeeds.
  std::string refusal(const std::string& content,
                      ErrorId expected = ErrorId::kObjectFileInvalid) const {
    const std::string path = fileOf("damaged.json", content);
    try {
      load(kDecals, path);
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.id()), static_cast<int>(expected)) << error.what();
      EXPECT_TRUE(error.detail().starts_with(path + ": ")) << error.what();
      EXPECT_EQ(error.detail().find('\n'), std::string::npos) << error.what();
      return error.detail().substr(path.size() + 2);
    }
    return "";
  }

  static std::string saved(size_t count) {
    std::mt19937_64 random(count);
    return jsonOf(randomObjects(random, count).view());
  }
};

TEST_F(DamagedObjects, CutShortAnywhere) {
  const std::string whole = saved(3);
  for (size_t length = 0; length + 1 < whole.size(); ++length) {
    EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
  }
  // Without its last line break, the file is still complete.
  EXPECT_EQ(refusal(whole.substr(0, whole.size() - 1)), "");
}

// Loading never crashes, and any objects that it returns are valid.
TEST_F(DamagedObjects, WithAnyByteChanged) {
  const std::string whole = saved(2);
  std::mt19937 random(1);
  for (int i = 0; i < 4000; ++i) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      const Objects read = load(kDecals, fileOf("damaged.json", damaged));
      Objects again(kDecals);
      again.append(read.view());
      EXPECT_TRUE(sameObjects(again.view(), read.view()));
    } catch (const Error& error) {
      EXPECT_TRUE(error.id() == ErrorId::kObjectFileInvalid ||
                  error.id() == ErrorId::kObjectFileVersion)
          << error.what();
    }
  }
}

struct Bad {
  std::string text;
  const char* said;  // part of the message
};

TEST_F(DamagedObjects, FaultsAroundTheObjectsAreNamed) {
  const Bad bad[] = {
      {"", "line 1"},
      {" \n\n[", "it is an array, not an object"},
      {"null", "it is null, not an object"},
      {"3", "it is a number, not an object"},
      {"{}", "it has no \"version\""},
      {R"({"version": 1})", "it has no \"decals\""},
      {R"({"decals": []})", "it has no \"version\""},
      {R"({"version": 1, "decals": []} x)", "line 1, column 30"},
      {R"({"version": 1, "version": 1, "decals": []})", "version is given twice"},
      {R"({"version": 1, "decals": [], "decals": []})", "decals is given twice"},
      {R"({"version": 1, "dekals": []})", "a member \"dekals\""},
      {R"({"version": "1", "decals": []})", "version is a text, not a number"},
      {R"({"version": [1], "decals": []})", "version is an array, not a number"},
      {R"({"version": null, "decals": []})", "version is null"},
      {R"({"version": 1, "decals": {}})", "decals is an object, not an array"},
      {R"({"version": 1, "decals": 3})", "decals is a number, not an array"},
      {R"({"version": 1, "decals": [[]]})", "decals[0] is an array, not an object"},
      {R"({"version": 1, "decals": [null]})", "decals[0] is null"},
      {"{\"version\": 1, // remark\n\"decals\": []}", "line 1"},
      {"{\"version\": 1,\n\"decals\": [],}", "line 2"},
  };
  for (const Bad& one : bad) {
    const std::string why = refusal(one.text);
    EXPECT_NE(why.find(one.said), std::string::npos) << one.text << "\n" << why;
  }
}

// Each text replaces the last members of the second object.
TEST_F(DamagedObjects, FaultsOfAnObjectAreNamedByObjectAndField) {
  const Bad bad[] = {
      {R"("size": -2)", "decals[1].size is -2, out of -1 to 1000000"},
      {R"("size": 1e7)", "decals[1].size is 10000000, out of"},
      {R"("size": 1e400)", "in decals[1].size: "},
      {R"("size": NaN)", "in decals[1].size: "},
      {R"("size": [1])", "decals[1].size is an array, not a number"},
      {R"("size": null)", "decals[1].size is null, not a number"},
      {R"("size": "1")", "decals[1].size is a text, not a number"},
      {R"("size": true)", "decals[1].size is a truth value"},
      {R"("size": 1, "size": 1)", "decals[1].size is given twice"},
      {R"("sise": 1)", "decals[1] there is no field \"sise\", nearest is size"},
      {R"("Size": 1)", "decals[1] there is no field \"Size\""},
      {R"("colour": [0, 0, 2])", "decals[1].colour[2] is 2, out of 0 to 1"},
      {R"("colour": [0, -1, 0])", "decals[1].colour[1] is -1"},
      {R"("colour": [0, "1", 0])", "decals[1].colour holds a text, not three numbers"},
      {R"("colour": [0, [1], 0])", "decals[1].colour holds an array"},
      {R"("colour": [0, {}, 0])", "decals[1].colour holds an object"},
      {R"("colour": [0, 0])", "decals[1].colour has 2 numbers, not 3"},
      {R"("colour": [0, 0, 0, 0])", "decals[1].colour has more than 3 numbers"},
      {R"("colour": [0, 1e999, 0])", "in decals[1].colour: "},
      {R"("colour": "#ffffff")", "decals[1].colour is a text, not an array of 3 numbers"},
      {R"("colour": {})", "decals[1].colour is an object"},
      {R"("note": 3)", "decals[1].note is a number, not a text"},
      {R"("note": ["a"])", "decals[1].note is an array, not a text"},
      {R"("note": "a\nb")", "decals[1].note holds the control character 0x0a"},
      {R"("note": "a\u0000b")", "decals[1].note holds the control character 0x00"},
      {"\"note\": \"\xff\"", "in decals[1].note: "},
      {R"("note": "\ud800")", "in decals[1].note: "},
      {R"("picture": ")" + std::string(4097, 'x') + "\"", "decals[1].picture has 4097 bytes"},
  };
  const std::string before = R"({"version": 1,
"decals": [
{"position": [0, 0, 0], "direction": [0, 0, 1], "colour": [0, 0, 0]},
{"position": [0, 0, 0],
"direction": [0, 1, 0],
)";
  for (const Bad& one : bad) {
    const std::string why = refusal(before + one.text + "\n}\n]}");
    EXPECT_TRUE(why.starts_with(one.said)) << one.text.substr(0, 100) << "\n" << why;
  }
  EXPECT_EQ(refusal(before + R"("size": 1}]})"), "");
  EXPECT_EQ(refusal(R"({"version": 1, "decals": [{"position": [0, 0, 0]}]})"),
            "decals[0] has no \"direction\"");
  EXPECT_EQ(refusal(R"({"version": 1, "decals": [{}]})"), "decals[0] has no \"position\"");
}

// The version is checked before all other fields, which another version may define differently.
TEST_F(DamagedObjects, OtherVersionsAreRefusedByNumber) {
  for (const char* version : {"0", "2", "-1", "1.5", "18446744073709551616"}) {
    const std::string text = fmt::format(R"({{"version": {}, "new": [], "decals": 1}})", version);
    EXPECT_TRUE(refusal(text, ErrorId::kObjectFileVersion).starts_with("version is ")) << version;
  }
}

TEST_F(DamagedObjects, HostileFilesEndInARefusal) {
  const size_t deep = 1000000;
  const std::string digits(deep, '9');
  const std::string head = R"({"version": 1, "decals": [)";
  for (const std::string& text : {
           std::string(deep, '['),
           head + std::string(deep, '{'),
           head + std::string(deep, '['),
           head + "{\"position\": " + std::string(deep, '['),
           head + "{\"position\": [" + digits,
           head + "{\"position\": [1e" + digits,
           head + "{\"" + digits,
           head + "{\"" + digits + "\": 1}]}",
           head + "{\"note\": \"" + digits + "\"}]}",
           "{\"" + digits + "\": 1}",
           std::string(deep, '\n') + "x",
           std::string(deep, '\0'),
           std::string("\xff\xfe{\0", 4),
           head + "{\"\xc0\x80\": 1}]}",
       }) {
    const std::string why = refusal(text);
    EXPECT_NE(why, "") << text.substr(0, 60);
    EXPECT_LT(why.size(), 2000u) << text.substr(0, 60);
  }
}

}  // namespace
}  // namespace grisaille::objects
