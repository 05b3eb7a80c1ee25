// SPDX-License-Identifier: MIT
#include "core/base/regular_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille {
namespace {

constexpr ErrorId kId = ErrorId::kSceneUnreadable;

class RegularFile : public tests::FolderTest {};

TEST_F(RegularFile, IsReadWholeDirectlyOrThroughLinks) {
  std::string content = "a\r\n\xff";
  content += '\0';
  fileOf("a", content);
  std::filesystem::create_symlink("a", file("link"));
  EXPECT_EQ(readRegularFile(file("a"), kId), content);
  EXPECT_EQ(readRegularFile(file("link"), kId), content);
  EXPECT_EQ(readRegularFile(fileOf("empty", ""), kId), "");
  EXPECT_EQ(whyNotRegular(file("link")), "");
  EXPECT_TRUE(openRegularFileIfThere(file("a"), kId).has_value());
  EXPECT_FALSE(openRegularFileIfThere(file("missing"), kId).has_value());
}

TEST_F(RegularFile, EverythingElseIsRefusedByPathAndReason) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("nowhere", file("dangling"));
  for (const std::string& path : {file("pipe"), file("dangling"), file("missing"), folder_.string(),
                                  std::string("/dev/zero")}) {
    EXPECT_NE(whyNotRegular(path), "") << path;
    EXPECT_ERROR(kId, requireRegularFile(path, kId));
    EXPECT_ERROR(kId, readRegularFile(path, kId));
    EXPECT_ERROR(kId, openRegularFile(path, kId));
    try {
      requireRegularFile(path, kId);
    } catch (const Error& error) {
      EXPECT_EQ(error.detail(), path + ": " + whyNotRegular(path));
    }
  }
  EXPECT_EQ(whyNotRegular(file("pipe")), "it is a named pipe; only regular files are read");
}

TEST_F(RegularFile, LongFilesAreRefused) {
  const std::string path = fileOf("a", "12345");
  EXPECT_EQ(readRegularFile(path, kId, 5), "12345");
  EXPECT_ERROR(kId, readRegularFile(path, kId, 4));
}

}  // namespace
}  // namespace grisaille
