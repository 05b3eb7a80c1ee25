// SPDX-License-Identifier: MIT
#include "app/viewer/bookmarks.h"

#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille::app::viewer {
namespace {

class BookmarksTest : public tests::FolderTest {
 protected:
  Bookmarks bookmarks() const { return Bookmarks(folder_ / "some" / "cameras"); }
};

TEST_F(BookmarksTest, AreListedByNameAsTheyWereSaved) {
  EXPECT_TRUE(bookmarks().list().empty());
  const scene::Camera camera{.eye = {0.1, 1.0 / 3, -7}, .target = {1, 2, 3}, .fovyDegrees = 33.3};
  for (const char* name : {"zebra", "the lion's head", "ä", "a.b", "-rf"}) {
    bookmarks().save(name, scene::atriumCamera());
    bookmarks().save(name, camera);
  }
  const auto list = bookmarks().list();
  ASSERT_EQ(list.size(), 5u);
  const char* names[] = {"-rf", "a.b", "the lion's head", "zebra", "ä"};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(list[i].name, names[i]);
    EXPECT_EQ(list[i].error, "");
    ASSERT_TRUE(list[i].camera);
    EXPECT_EQ(list[i].camera->eye, camera.eye);
    EXPECT_EQ(list[i].camera->fovyDegrees, camera.fovyDegrees);
  }
  bookmarks().remove("zebra");
  bookmarks().remove("zebra");
  EXPECT_EQ(bookmarks().list().size(), 4u);
}

TEST_F(BookmarksTest, ABrokenOneLeavesTheOthers) {
  bookmarks().save("good", scene::atriumCamera());
  fileOf("some/cameras/bad.json", "{\"eye\": 1}");
  fileOf("some/cameras/empty.json", "");
  fileOf("some/cameras/notes.txt", "not a camera");
  std::filesystem::create_directories(folder_ / "some/cameras/folder.json");
  const auto list = bookmarks().list();
  ASSERT_EQ(list.size(), 4u);
  for (const Bookmarks::Entry& entry : list) {
    EXPECT_EQ(entry.camera.has_value(), entry.name == "good");
    EXPECT_EQ(entry.error.empty(), entry.name == "good");
    EXPECT_EQ(entry.error.find('\n'), std::string::npos);
  }
  EXPECT_EQ(list[0].error.rfind("error E2202: ", 0), 0u) << list[0].error;
  bookmarks().save("bad", scene::atriumCamera());
  EXPECT_EQ(bookmarks().list()[0].error, "");
}

TEST_F(BookmarksTest, NamesThatAreNoFilesAreRefused) {
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("../up"),
        std::string("a/b"), std::string("a\\b"), std::string(".hidden"), std::string("a\nb"),
        std::string("a\0b", 3), std::string(201, 'x')}) {
    EXPECT_ERROR(ErrorId::kBookmarkName, bookmarks().save(name, scene::atriumCamera()));
    EXPECT_ERROR(ErrorId::kBookmarkName, bookmarks().remove(name));
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "some"));
  bookmarks().save(std::string(200, 'x'), scene::atriumCamera());
}

TEST_F(BookmarksTest, WhatCannotBeWrittenSaysSo) {
  fileOf("some", "a file in the way");
  EXPECT_ERROR(ErrorId::kFileUnwritable, bookmarks().save("a", scene::atriumCamera()));
  EXPECT_TRUE(bookmarks().list().empty());
}

}  // namespace
}  // namespace grisaille::app::viewer
