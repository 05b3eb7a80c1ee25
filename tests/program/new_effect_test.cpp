// SPDX-License-Identifier: MIT
// `grisaille new-effect`: refused names, and files that it leaves alone. tests/build builds and
// runs its projects.
#include <gtest/gtest.h>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

struct NewEffect : ::testing::Test {
  Outcome newEffect(std::vector<std::string> arguments,
                    const std::vector<std::string>& environment = {}) {
    arguments.insert(arguments.begin(), "new-effect");
    return runProgram(arguments, folder.path(), environment);
  }
  void expectRefused(const std::vector<std::string>& arguments, const std::string& number,
                     const std::string& mention) {
    const Outcome outcome = newEffect(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_EQ(outcome.err.rfind("error " + number + ": ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << outcome.err;
  }
  TemporaryFolder folder;
};

TEST_F(NewEffect, BadNamesAreRefusedAndNothingIsWritten) {
  for (const std::string name : {"Outline", "2d", "_x", "out-line", "a b", "../x", "ä", "x.y",
                                 "a23456789012345678901234567890123456789012"}) {
    expectRefused({name}, "E5401", "is not a valid effect key");
  }
  expectRefused({""}, "E5101", "the value is empty");
  expectRefused({"ssao"}, "E5401", "ssao.so");
  expectRefused({"effects"}, "E5401", "settings files");
  expectRefused({"fine", "folder", "--language", "rust"}, "E5101", "--language");
  EXPECT_TRUE(folder.files().empty());
}

TEST_F(NewEffect, FoldersThatHoldSomethingAreLeftAlone) {
  fs::create_directory(folder.path() / "full");
  folder.write("full/mine.txt", "mine");
  expectRefused({"full"}, "E5402", "is not empty");
  expectRefused({"other", "full/mine.txt"}, "E5402", "not a folder");
  EXPECT_EQ(readFile(folder / "full/mine.txt"), "mine");
  expectRefused({"other", "/proc/nothing/here"}, "E4103", "/proc");
  EXPECT_EQ(folder.files(), std::vector<std::string>{"full"});
}

TEST_F(NewEffect, AnEmptyFolderIsTaken) {
  fs::create_directory(folder.path() / "empty");
  const Outcome outcome = newEffect({"edge_lines", "empty"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = readFile(folder / "empty/edge_lines.cpp");
  EXPECT_NE(text.find("class EdgeLinesEffect"), std::string::npos);
  EXPECT_NE(text.find(".label = \"Edge lines\""), std::string::npos);
  for (const auto& entry : fs::directory_iterator(folder.path() / "empty")) {
    EXPECT_EQ(readFile(entry.path()).find("@KEY@"), std::string::npos) << entry.path();
  }
}

// CMake finds a package next to a folder of the PATH. Otherwise the printed command names its
// location.
TEST_F(NewEffect, TheCommandThatItPrintsFindsThePackage) {
  const std::string bin = fs::path(PROGRAM).parent_path();
  EXPECT_EQ(newEffect({"one"}, {"PATH=/usr/bin:" + bin}).out.find("CMAKE_PREFIX_PATH"),
            std::string::npos);
  EXPECT_NE(newEffect({"two"}, {"PATH=/usr/bin"})
                .out.find("CMAKE_PREFIX_PATH=" + fs::path(bin).parent_path().string() + " cmake"),
            std::string::npos);
}

}  // namespace
}  // namespace grisaille::tests
