// SPDX-License-Identifier: MIT
#include "app/options/sequence.h"

#include <gtest/gtest.h>

#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app {
namespace {

TEST(FileName, NumbersStandWhereTheNameSays) {
  EXPECT_EQ(FileName("a.exr").at(7), "a.exr");
  EXPECT_FALSE(FileName("take#1.exr").numbered());
  EXPECT_EQ(FileName("a.####.exr").at(7), "a.0007.exr");
  EXPECT_EQ(FileName("a.##.exr").at(123), "a.123.exr");
  EXPECT_EQ(FileName("dir/%04d").at(12), "dir/0012");
  EXPECT_EQ(FileName("a%d.exr").at(12), "a12.exr");
  for (const char* name : {"%04d.####.exr", "####/a.exr", "%03d/%03d.exr", "a.##########.exr"}) {
    EXPECT_ERROR(ErrorId::kSequence, FileName{name});
  }
}

TEST(FileName, MayBeAsLongAsAPathCanBe) {
  EXPECT_FALSE(FileName(std::string(4096, 'd')).numbered());
  EXPECT_ERROR(ErrorId::kSequence, FileName(std::string(4096, '#')));
  EXPECT_ERROR(ErrorId::kSequence, FileName(std::string(200000, '#')));
}

TEST(FileName, FindsTheFilesOfItsNumbersAlone) {
  const tests::TemporaryFolder folder;
  for (const char* name :
       {"a.0001.exr", "a.0010.exr", "a.0003.exr", "a.12345.exr", "a.004.exr", "a.00006.exr",
        "a..exr", "a.-001.exr", "a.0005.png", "b.0007.exr", "a.00x1.exr", "a.0008.exr.part"}) {
    folder.write(name, "");
  }
  EXPECT_EQ(FileName(folder / "a.####.exr").numbers(), (std::vector<int>{1, 3, 10, 12345}));
  EXPECT_EQ(FileName(folder / "a.%04d.exr").numbers(), (std::vector<int>{1, 3, 10, 12345}));
  EXPECT_EQ(FileName(folder / "b.####.exr").numbers(), std::vector<int>{7});
  EXPECT_ERROR(ErrorId::kSequence, FileName(folder / "c.####.exr").numbers());
  EXPECT_ERROR(ErrorId::kSequence, FileName(folder / "no/c.####.exr").numbers());
}

TEST(Frames, AreARangeWithAStep) {
  EXPECT_EQ(parseFrames("7"), std::vector<int>{7});
  EXPECT_EQ(parseFrames("3-5"), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(parseFrames("0-10x4"), (std::vector<int>{0, 4, 8}));
  for (const char* text : {"", "a", "5-3", "1-", "-3", "1-9x0", "1-3-5", "0-999999999", "1.5"}) {
    EXPECT_ERROR(ErrorId::kUsage, parseFrames(text));
  }
}

TEST(Times, StepsMayBeFractionsAndMeetTheLast) {
  using Times = std::vector<double>;
  EXPECT_EQ(parseTimes("0:1:0.25"), (Times{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(parseTimes("0.5:0.5:1"), Times{0.5});
  EXPECT_EQ(parseTimes("1/2:1:1/3"), (Times{0.5, 0.5 + 1.0 / 3}));
  EXPECT_EQ(parseTimes("0:1e-1:2e-2").size(), 6u);
  const Times film = parseTimes("0:4:1/24");
  ASSERT_EQ(film.size(), 97u);
  EXPECT_EQ(film[12], 0.5);
  EXPECT_EQ(film.back(), 4);
  // Rounding of a decimal step loses no frame, and none lies after the last time.
  const Times third = parseTimes("0:1:0.3333333333");
  ASSERT_EQ(third.size(), 4u);
  EXPECT_EQ(third.back(), 1);
  EXPECT_EQ(parseTimes("0:99999:1").size(), 100000u);
}

TEST(Times, OthersAreRefused) {
  for (const std::string text :
       {"", "0:1", "0:1:0", "1:0:0.1", "-1:1:0.1", "0:1:-0.1", "0:1:1/0", "0:1:1/2/3", "a:b:c",
        "0:1:0.1:2", "0:inf:1", "0:nan:1", "0:1:nan", " 0:1:1", "0:100000:1", "0:1:1e-300",
        "0:1:1e-9", "0:1e308/1e-308:1"}) {
    EXPECT_ERROR(ErrorId::kUsage, parseTimes(text));
  }
  EXPECT_ERROR(ErrorId::kUsage, parseTimes(std::string(100000, ':')));
}

}  // namespace
}  // namespace grisaille::app
