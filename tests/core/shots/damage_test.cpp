// SPDX-License-Identifier: MIT
// Files of shots that are not whole or not sound.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "core/shots/shot_file.h"
#include "tests/core/shots/random_shots.h"
#include "tests/core/shots/temporary_folder.h"
#include "tests/support/expect_error.h"

namespace grisaille::shots {
namespace {

class DamagedShots : public FolderTest {
 protected:
  // The detail of the refusal, "" where it is read.
  std::string refusal(const std::string& content, ErrorId expected) const {
    const std::string path = fileOf("damaged", content);
    try {
      load(path);
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.id()), static_cast<int>(expected)) << error.what();
      EXPECT_TRUE(error.detail().starts_with(path + ":")) << error.what();
      return error.detail().substr(path.size() + 1);
    }
    return "";
  }

  std::string saved(const std::string& name, size_t count) const {
    std::mt19937_64 random(count);
    save(randomShots(random, count), file(name));
    return contentOf(file(name));
  }
};

TEST_F(DamagedShots, BinaryCutShortAnywhere) {
  const std::string whole = saved("a.shots", 3);
  for (size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(refusal(whole.substr(0, length), ErrorId::kShotFileInvalid), "") << length;
  }
  EXPECT_NE(refusal(whole + '\0', ErrorId::kShotFileInvalid), "");
  EXPECT_EQ(refusal(whole, ErrorId::kShotFileInvalid), "");
}

TEST_F(DamagedShots, BinaryWithAnyBitFlipped) {
  const std::string whole = saved("a.shots", 2);
  for (size_t i = 0; i < whole.size(); ++i) {
    for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      const bool version = i >= 8 && i < 12;
      EXPECT_NE(refusal(damaged, version ? ErrorId::kShotFileVersion : ErrorId::kShotFileInvalid),
                "")
          << "byte " << i;
    }
  }
}

TEST_F(DamagedShots, BinaryThatCountsMoreThanItHolds) {
  const std::string whole = saved("a.shots", 2);
  // 2^61 / 52 and such: sizes that wrap around.
  for (const uint64_t count : {uint64_t{0}, uint64_t{1}, uint64_t{3}, uint64_t{1} << 32,
                               ~uint64_t{0}, (~uint64_t{0} / 52) + 3, (uint64_t{1} << 62) + 2}) {
    std::string damaged = whole;
    std::memcpy(damaged.data() + 12, &count, sizeof count);
    EXPECT_TRUE(refusal(damaged, ErrorId::kShotFileInvalid).starts_with(" byte 12:")) << count;
  }
}

TEST_F(DamagedShots, BinaryWithABadValueNamesShotAndByte) {
  std::string damaged = saved("a.shots", 3);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(damaged.data() + 20 + 2 * 52 + 8, &bad, sizeof bad);
  const std::string why = refusal(damaged, ErrorId::kShotFileInvalid);
  EXPECT_TRUE(why.starts_with(" byte 124: shots[2].origin[1] ")) << why;
}

TEST_F(DamagedShots, JsonCutShortAnywhere) {
  const std::string whole = saved("a.json", 3);
  for (size_t length = 0; length + 1 < whole.size(); ++length) {
    EXPECT_NE(refusal(whole.substr(0, length), ErrorId::kShotFileInvalid), "") << length;
  }
  // Without its last line break it is whole.
  EXPECT_EQ(refusal(whole.substr(0, whole.size() - 1), ErrorId::kShotFileInvalid), "");
}

// Never a crash, and what is read is sound.
TEST_F(DamagedShots, JsonWithAnyByteChanged) {
  const std::string whole = saved("a.json", 2);
  std::mt19937 random(1);
  for (int i = 0; i < 4000; ++i) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      for (const grisaille_shot& shot : load(fileOf("damaged", damaged))) check(shot);
    } catch (const Error& error) {
      EXPECT_TRUE(error.id() == ErrorId::kShotFileInvalid ||
                  error.id() == ErrorId::kShotFileVersion)
          << error.what();
    }
  }
}

struct BadJson {
  const char* text;
  const char* start;  // of what is said: the place and what stands there
};

const BadJson kBadJson[] = {
    {"", "1:0: "},
    {" \n\n[", "3:1: the file is an array"},
    {"null", "1:4: the file is null"},
    {"{}", "1:2: the file has no \"version\""},
    {R"({"version": 1})", "1:14: the file has no \"shots\""},
    {R"({"shots": []})", "1:13: the file has no \"version\""},
    {R"({"version": 1, "shots": []} x)", "1:29: "},
    {R"({"version": 1, "version": 1, "shots": []})", "1:24: the file has two members \"version\""},
    {R"({"version": 1, "shots": [], "shots": []})", "1:35: the file has two members \"shots\""},
    {R"({"version": 1, "shoots": []})",
     "1:23: the file has no member \"shoots\", nearest is shots"},
    {R"({"version": "1", "shots": []})", "1:15: version is a string"},
    {R"({"version": [1], "shots": []})", "1:13: version is an array"},
    {R"({"version": 1, "shots": {}})", "1:25: shots is an object"},
    {R"({"version": 1, "shots": 3})", "1:26: shots is a number"},
    {R"({"version": 1, "shots": [[]]})", "1:26: shots[0] is an array"},
    {R"({"version": 1, "shots": [1e400]})", "1:31: in shots[0]: number overflow"},
    {"{\"version\": 1, // remark\n\"shots\": []}", "1:16: "},
    {"{\"version\": 1, \"shots\": [],}", "1:28: "},
};

TEST_F(DamagedShots, JsonIsRefusedByPlace) {
  for (const BadJson& bad : kBadJson) {
    const std::string why = refusal(bad.text, ErrorId::kShotFileInvalid);
    EXPECT_TRUE(why.starts_with(bad.start)) << bad.text << "\n" << why;
  }
}

// What stands for the last member of the second shot, which begins on line 4.
const BadJson kBadMember[] = {
    {R"("color": [0, 0, 0], "range": -1)", "4:1: shots[1].range is -1"},
    {R"("color": [0, 0, 0], "range": 1e-40)", "4:1: shots[1].range"},
    {R"("color": [0, 0, 0], "range": 1e7)", "4:1: shots[1].range"},
    {R"("range": 1e400)", "6:15: in shots[1].range: number overflow"},
    {R"("range": [1])", "6:10: shots[1].range is an array"},
    {R"("range": null)", "6:13: shots[1].range is null"},
    {R"("range": NaN)", "6:10: in shots[1].range: "},
    {R"("range": 1, "range": 1)", "6:19: shots[1] has two members \"range\""},
    {R"("rnage": 1)", "6:7: shots[1] has no member \"rnage\", nearest is range"},
    {R"("Color": [0, 0, 0])", "6:7: shots[1] has no member \"Color\""},
    {R"("color": [0, 0, 2])", "4:1: shots[1].color[2] is 2"},
    {R"("color": [0, -1, 0])", "4:1: shots[1].color[1] is -1"},
    {R"("color": [0, "1", 0])", "6:16: shots[1].color[1] is a string"},
    {R"("color": [0, [1], 0])", "6:14: shots[1].color[1] is an array"},
    {R"("color": [0, 0])", "6:15: shots[1].color holds 2 numbers"},
    {R"("color": [0, 0, 0, 0])", "6:21: shots[1].color holds 4 numbers"},
    {R"("color": "#ffffff")", "6:18: shots[1].color is a string"},
    {R"("color": {})", "6:10: shots[1].color is an object"},
    {R"("color": true)", "6:13: shots[1].color is true or false"},
    {R"("range": 1)", "4:1: shots[1] has no \"color\""},
};

TEST_F(DamagedShots, JsonIsRefusedByShotAndLine) {
  const std::string before = R"({"version": 1,
"shots": [
{"origin": [0, 0, 0], "direction": [0, 0, 1], "color": [0, 0, 0]},
{"origin": [0, 0, 0],
"direction": [0, 1, 0],
)";
  for (const BadJson& bad : kBadMember) {
    const std::string why = refusal(before + bad.text + "\n}\n]}", ErrorId::kShotFileInvalid);
    EXPECT_TRUE(why.starts_with(bad.start)) << bad.text << "\n" << why;
  }
  EXPECT_EQ(refusal(before + R"("color": [0, 0, 0]}]})", ErrorId::kShotFileInvalid), "");
}

TEST_F(DamagedShots, JsonPlacesAreRightInLongFiles) {
  for (size_t pad = 65520; pad < 65550; ++pad) {
    const std::string spaces(pad, ' ');
    EXPECT_TRUE(refusal(spaces + "[", ErrorId::kShotFileInvalid)
                    .starts_with(fmt::format("1:{}: the file is an array", pad + 1)));
    EXPECT_TRUE(refusal(spaces + "\n[", ErrorId::kShotFileInvalid)
                    .starts_with("2:1: the file is an array"));
    EXPECT_TRUE(refusal(fmt::format("{0}\n\n{0}[", spaces), ErrorId::kShotFileInvalid)
                    .starts_with(fmt::format("3:{}: the file is an array", pad + 1)));
  }
}

TEST_F(DamagedShots, OtherVersionsAreRefusedByNumber) {
  for (const char* version : {"0", "2", "-1", "1.5", "18446744073709551616"}) {
    const std::string text =
        R"({"version": )" + std::string(version) + R"(, "new": [], "shots": 1})";
    EXPECT_TRUE(refusal(text, ErrorId::kShotFileVersion).starts_with("1:")) << version;
  }
  std::string binary = saved("a.shots", 1);
  binary[8] = 2;
  EXPECT_TRUE(refusal(binary, ErrorId::kShotFileVersion).starts_with(" byte 8: version 2"));
}

TEST_F(DamagedShots, HostileJsonEndsInARefusal) {
  const size_t deep = 1000000;
  const std::string digits(deep, '9');
  const std::string head = R"({"version": 1, "shots": [)";
  for (const std::string& text : {
           std::string(deep, '['),
           fmt::format("{}{}", head, std::string(deep, '{')),
           fmt::format("{}{}", head, std::string(deep, '[')),
           fmt::format("{}{{\"origin\": {}", head, std::string(deep, '[')),
           fmt::format("{}{{\"origin\": [{}", head, digits),
           fmt::format("{}{{\"origin\": [1e{}", head, digits),
           fmt::format("{}{{\"{}", head, digits),
           fmt::format("{}{{\"{}\": 1}}]}}", head, digits),
           std::string(deep, '\n') + "x",
           std::string(deep, '\0'),
           std::string("\xff\xfe{\0", 4),
           head + "{\"\xc0\x80\": 1}]}",
       }) {
    EXPECT_NE(refusal(text, ErrorId::kShotFileInvalid), "") << text.substr(0, 60);
  }
  EXPECT_TRUE(
      refusal(std::string(deep, '\n') + "x", ErrorId::kShotFileInvalid).starts_with("1000001:1: "));
}

}  // namespace
}  // namespace grisaille::shots
