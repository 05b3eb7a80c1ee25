// SPDX-License-Identifier: MIT
#include "app/apply/channels.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace grisaille::app {
namespace {

// Two pixels; channel n holds n in the first and 10 + n in the second.
image::Picture of(std::vector<std::string> channels) {
  const auto count = static_cast<uint32_t>(channels.size());
  image::Picture picture{.image = {.width = 2, .height = 1, .channels = count, .pixels = {}},
                         .channels = std::move(channels),
                         .matrices = {}};
  for (size_t i = 0; i < 2 * picture.channels.size(); ++i) {
    const size_t channel = i % picture.channels.size();
    picture.image.pixels.push_back(
        static_cast<float>(i < picture.channels.size() ? channel : 10 + channel));
  }
  return picture;
}

using Pixels = std::vector<float>;

TEST(Channels, DepthIsWhatTheNamesTell) {
  const auto depth = [](std::vector<std::string> channels, const std::string& name = "") {
    return depthChannel(of(std::move(channels)), name, "file").pixels;
  };
  EXPECT_EQ(depth({"Y"}), (Pixels{0, 10}));
  EXPECT_EQ(depth({"R", "G", "B", "Z"}), (Pixels{3, 13}));
  EXPECT_EQ(depth({"View.Combined.R", "View.Depth.Z", "View.Normal.Z"}), (Pixels{1, 11}));
  EXPECT_EQ(depth({"R", "G", "B"}, "G"), (Pixels{1, 11}));
  EXPECT_ERROR(ErrorId::kPictureChannels, depth({"R", "G", "B"}));
  EXPECT_ERROR(ErrorId::kPictureChannels, depth({"depth.A", "depth.B"}));
  EXPECT_ERROR(ErrorId::kPictureChannels, depth({"R", "G", "B"}, "Q"));
}

TEST(Channels, NormalsAreWhatTheNamesTell) {
  const auto normal = [](std::vector<std::string> channels, const std::string& names = "") {
    return normalChannels(of(std::move(channels)), names, "file").pixels;
  };
  EXPECT_EQ(normal({"R", "G", "B"}), (Pixels{0, 1, 2, 10, 11, 12}));
  EXPECT_EQ(normal({"R", "G", "B", "A"}), (Pixels{0, 1, 2, 10, 11, 12}));
  EXPECT_EQ(normal({"R", "G", "B", "A", "N.X", "N.Y", "N.Z"}), (Pixels{4, 5, 6, 14, 15, 16}));
  EXPECT_EQ(normal({"Z", "View.Normal.X", "View.Normal.Y", "View.Normal.Z"}),
            (Pixels{1, 2, 3, 11, 12, 13}));
  EXPECT_EQ(normal({"a", "b", "c", "d", "e"}, "e,a,c"), (Pixels{4, 0, 2, 14, 10, 12}));
  EXPECT_ERROR(ErrorId::kPictureChannels, normal({"Y"}));
  EXPECT_ERROR(ErrorId::kPictureChannels, normal({"a", "b", "c", "d", "e"}));
  EXPECT_ERROR(ErrorId::kPictureChannels, normal({"R", "G", "B"}, "R,G"));
  EXPECT_ERROR(ErrorId::kPictureChannels, normal({"R", "G", "B"}, "R,G,X"));
}

TEST(Channels, ColourIsTheFirstThree) {
  EXPECT_EQ(colourChannels(of({"R", "G", "B", "A"}), "file").pixels, (Pixels{0, 1, 2, 10, 11, 12}));
  EXPECT_ERROR(ErrorId::kPictureChannels, colourChannels(of({"Y"}), "file"));
}

}  // namespace
}  // namespace grisaille::app
