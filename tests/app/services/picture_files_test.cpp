// SPDX-License-Identifier: MIT
#include <filesystem>
#include <utility>
#include <vector>

#include "app/services/scene_services.h"
#include "tests/support/folder_test.h"

namespace grisaille::app {
namespace {

using PictureFilesTest = tests::FolderTest;

TEST_F(PictureFilesTest, WarnsOnceUntilTheFileIsMended) {
  std::vector<std::pair<std::string, std::string>> told;
  PictureFiles files(
      [&](const std::string& path, const std::string& text) { told.emplace_back(path, text); });
  const std::string path = file("moss.png");
  grisaille_picture picture{};
  picture.struct_size = sizeof(picture);
  const auto fails = [&] { EXPECT_THROW(files.read(path.c_str(), picture), Error); };
  fails();
  fails();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].first, path);
  EXPECT_NE(told[0].second.find("moss.png"), std::string::npos) << told[0].second;
  image::Image grey;
  grey.width = 3;
  grey.height = 2;
  grey.channels = 3;
  grey.pixels.assign(18, 0.5f);
  image::write(grey, path);
  files.read(path.c_str(), picture);
  EXPECT_EQ(picture.width, 3u);
  files.read(path.c_str(), picture);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[1], std::pair(path, std::string()));
  std::filesystem::remove(path);
  fails();
  ASSERT_EQ(told.size(), 3u);
  EXPECT_NE(told[2].second, "");
}

}  // namespace
}  // namespace grisaille::app
