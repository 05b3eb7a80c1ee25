// SPDX-License-Identifier: MIT
#include "app/viewer/file_list.h"

#include <unistd.h>

#include "tests/support/folder_test.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

class FileList : public tests::FolderTest {
 protected:
  void SetUp() override {
    tests::FolderTest::SetUp();
    for (const char* name : {"hall.glb", "HALLWAY.GLTF", "half.glb", "a.toml", "b.json", "x.txt",
                             ".hidden.glb", "models/deep.glb", "more/z.glb"}) {
      fileOf(name, "");
    }
  }
  std::vector<std::string> names(FileKind kind) const {
    std::vector<std::string> all;
    for (const ListedFile& one : listFolder(folder_.string(), kind).files) all.push_back(one.name);
    return all;
  }
  std::string complete(const std::string& text) const {
    return completed(text, folder_.string(), FileKind::kAll);
  }
};

TEST_F(FileList, ShowsFoldersAndTheFilesOfAKind) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(FileKind::kScene),
            (Names{"models", "more", "HALLWAY.GLTF", "half.glb", "hall.glb"}));
  EXPECT_EQ(names(FileKind::kSettings), (Names{"models", "more", "a.toml"}));
  EXPECT_EQ(names(FileKind::kJson), (Names{"models", "more", "b.json"}));
  EXPECT_EQ(names(FileKind::kAll).size(), 7u);
}

TEST_F(FileList, CompletesWhatAllNamesAgreeOn) {
  EXPECT_EQ(complete("h"), "hal");
  EXPECT_EQ(complete("hall"), "hall.glb");
  EXPECT_EQ(complete("m"), "mo");
  EXPECT_EQ(complete("mod"), "models/");
  EXPECT_EQ(complete("models/"), "models/deep.glb");
  EXPECT_EQ(complete("none"), "none");
  EXPECT_EQ(complete(folder_.string() + "/mor"), folder_.string() + "/more/");
  EXPECT_EQ(wholePath("../x", "/a/b"), "/a/x");
  EXPECT_EQ(wholePath("/x", "/a/b"), "/x");
}

TEST_F(FileList, AFolderThatCannotBeReadSaysWhy) {
  EXPECT_NE(listFolder(file("missing"), FileKind::kAll).error, "");
  EXPECT_NE(listFolder(file("a.toml"), FileKind::kAll).error, "");
  if (geteuid() == 0) return;  // root reads every folder
  fs::permissions(folder_ / "models", fs::perms::none);
  EXPECT_NE(listFolder(file("models"), FileKind::kAll).error, "");
  fs::permissions(folder_ / "models", fs::perms::owner_all);
}

}  // namespace
}  // namespace grisaille::app::viewer
