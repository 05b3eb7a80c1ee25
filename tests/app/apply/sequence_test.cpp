// SPDX-License-Identifier: MIT
#include "app/apply/sequence.h"

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

}  // namespace
}  // namespace grisaille::app
