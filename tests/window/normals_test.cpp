// SPDX-License-Identifier: MIT
// Directions have negative numbers, which the window and PNGs show as (n + 1) / 2.
#include <cmath>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class NormalsTest : public WindowTest {};
GRISAILLE_IN_WINDOWS(NormalsTest);

TEST_P(NormalsTest, BentNormalsAreShownAndSavedLikeNormals) {
  for (const std::string view : {"ssao.bent_normal", "facet_normal"}) {
    DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--fresh", "--view", view}));
    const std::string file = viewer.savePicture();
    const image::Image picture = image::read(file);
    const image::Image saved = image::read(file.substr(0, file.size() - 4) + ".png");
    ASSERT_EQ(picture.channels, 3u) << view;
    ASSERT_EQ(saved.channels, 3u) << view;
    rest(viewer);
    const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<uint32_t>>();
    const uint32_t width = rect[2] - rect[0], height = rect[3] - rect[1];
    ASSERT_EQ(picture.width, width);
    ASSERT_EQ(picture.height, height);
    const std::vector<uint32_t> screen = display_.pixels(rect[0], rect[1], width, height);
    size_t off = 0, negative = 0;
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
      const size_t x = i / 3 % width, y = i / 3 / width;
      negative += picture.pixels[i] < -0.1f ? 1 : 0;
      const double expected = 255 * (double{picture.pixels[i]} + 1) / 2;
      off += std::abs(255 * double{saved.pixels[i]} - expected) > 0.51 ? 1 : 0;
      if (x + 150 > width && y < 150) continue;  // the axes
      off += std::abs((screen[i / 3] >> (16 - 8 * (i % 3)) & 255u) - expected) > 1 ? 1 : 0;
    }
    EXPECT_EQ(off, 0u) << view;
    EXPECT_GT(negative, picture.pixels.size() / 20) << view;
    expectQuits(viewer);
  }
}

}  // namespace
}  // namespace grisaille::tests
