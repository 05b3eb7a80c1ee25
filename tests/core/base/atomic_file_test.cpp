// SPDX-License-Identifier: MIT
#include "core/base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public tests::FolderTest {
 protected:
  std::string partOf(const std::string& name) const {
    return fmt::format("{}.{}.part", file(name), getpid());
  }
  mode_t modeOf(const std::string& name) const {
    struct stat status = {};
    EXPECT_EQ(stat(file(name).c_str(), &status), 0);
    return status.st_mode & 07777;
  }
};

TEST_F(AtomicFile, HoldsEveryByteAndNothingElse) {
  std::string content = "a\r\n\xff";
  content += '\0';
  for (const std::string& one : {content, std::string(), std::string(3'000'000, 'x')}) {
    writeFileAtomically(file("a"), one);
    EXPECT_EQ(contentOf(file("a")), one);
  }
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFile, AFailureLeavesNothingBehind) {
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeFileAtomically(file("missing/a"), "new"));
  fs::create_directory(file("folder"));
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeFileAtomically(file("folder"), "new"));
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeFileAtomically("", "new"));
  fs::create_symlink("round", file("round"));
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeFileAtomically(file("round"), "new"));
  EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(AtomicFile, AFullDiskKeepsTheOlderFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this machine has no /dev/full";
  writeFileAtomically(file("a"), "old");
  fs::create_symlink("/dev/full", partOf("a"));
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeFileAtomically(file("a"), "new"));
  EXPECT_EQ(contentOf(file("a")), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFile, LinksStayAndLeadToTheFile) {
  fs::create_directory(file("folder"));
  fs::create_symlink("folder/a", file("near"));
  fs::create_symlink(file("near"), file("far"));
  writeFileAtomically(file("far"), "new");  // link to a missing file
  EXPECT_EQ(contentOf(file("folder/a")), "new");
  EXPECT_TRUE(fs::is_symlink(file("far")));
  EXPECT_TRUE(fs::is_symlink(file("near")));
  EXPECT_EQ(targetOf(file("far")), targetOf(file("folder/a")));
  EXPECT_EQ(targetOf(file("folder/../folder/./a")), targetOf(file("folder/a")));
  EXPECT_NE(targetOf(file("a")), targetOf(file("folder/a")));
}

TEST_F(AtomicFile, AReplacedFileKeepsItsPermissions) {
  for (const mode_t mode : {0600u, 0640u, 0664u, 0755u}) {
    fileOf("a", "old");
    ASSERT_EQ(chmod(file("a").c_str(), mode), 0);
    writeFileAtomically(file("a"), "new");
    EXPECT_EQ(modeOf("a"), mode);
  }
  const mode_t mask = umask(027);
  writeFileAtomically(file("b"), "new");
  umask(mask);
  EXPECT_EQ(modeOf("b"), 0640u);
}

TEST_F(AtomicFile, APipeIsWrittenToAndStays) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = contentOf(file("pipe")); });
  writeFileAtomically(file("pipe"), "new");
  reader.join();
  EXPECT_EQ(read, "new");
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
  EXPECT_NO_THROW(writeFileAtomically("/dev/null", "new"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFile, WhatCannotBeWrittenIsToldBeforehand) {
  fileOf("a", "old");
  EXPECT_NO_THROW(requireWritable(file("a")));
  EXPECT_NO_THROW(requireWritable(file("b")));
  EXPECT_NO_THROW(requireWritableFolder(folder_.string()));
  EXPECT_ERROR(ErrorId::kFileUnwritable, requireWritable(file("missing/a")));
  EXPECT_ERROR(ErrorId::kFileUnwritable, requireWritable(folder_.string()));
  EXPECT_ERROR(ErrorId::kFileUnwritable, requireWritableFolder(file("a")));
  EXPECT_ERROR(ErrorId::kFileUnwritable, requireWritableFolder(file("a/folder")));
  EXPECT_EQ(contentOf(file("a")), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

}  // namespace
}  // namespace grisaille
