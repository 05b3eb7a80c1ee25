// SPDX-License-Identifier: MIT
// Painting in the viewer: paint lands on the clicked pixel, sprays while the button is held, and
// can be undone.
#include <fmt/format.h>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

using WindowPaintTest = WindowTest;
GRISAILLE_IN_WINDOWS(WindowPaintTest);

TEST_P(WindowPaintTest, LandsOnThePixelClicked) {
  DrivenViewer viewer(folder_,
                      arguments({"--effects", "ssao,sspm", "--view", "sspm.paint_coverage", "--set",
                                 "sspm.paint_range=0.02", "--set", "sspm.r0=0.002"}));
  viewer.key("b");
  viewer.untilValue("sspm.placing", "true");
  const Point at = viewer.at("picture", 0.37, 0.61);
  viewer.click(at);
  viewer.untilValue("sspm.objects", "1");
  const image::Image coverage = image::read(viewer.savePicture());
  const Point corner = viewer.at("picture", 0, 0);
  const auto x = static_cast<uint32_t>(at.x - corner.x), y = static_cast<uint32_t>(at.y - corner.y);
  // Full coverage where the ray hits, less around it.
  EXPECT_EQ(coverage.at(x, y), 1);
  for (const auto& [dx, dy] : {std::pair{8, 0}, {-8, 0}, {0, 8}, {0, -8}}) {
    EXPECT_LT(coverage.at(x + static_cast<uint32_t>(dx), y + static_cast<uint32_t>(dy)), 1)
        << dx << ", " << dy;
  }
  // Also with magnified pixels.
  viewer.key("b");
  viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) +
              " keydown ctrl click --repeat 8 4 keyup ctrl");
  viewer.untilChanged("zoom", "1");
  viewer.key("i");
  viewer.untilThere("value");
  const std::string value = viewer.value("value");
  EXPECT_EQ(value.find(fmt::format("{}, {}: 1", x, y)), 0u) << value << " at " << x << ", " << y;
  expectQuits(viewer);
}

TEST_P(WindowPaintTest, SprayIsOneStepAndColoursAreCounted) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", kWindow, "--effects", "sspm",
                                "--set", "sspm.paint_range=0.3"});
  viewer.key("b");
  viewer.untilValue("sspm.placing", "true");
  viewer.click(viewer.at("picture", 0.3, 0.5));
  viewer.untilValue("sspm.objects", "1");
  const Point at = viewer.at("picture", 0.7, 0.6);
  viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) + " mousedown 1");
  viewer.until("a spray", [](const nlohmann::json& now) {
    return std::stoi(now["sspm.objects"]["value"].get<std::string>()) > 4;
  });
  viewer.send("mouseup 1");
  viewer.untilDrawn();
  viewer.click("coverage");
  viewer.untilThere("coverage.none");
  EXPECT_LT(std::stod(viewer.value("coverage.none")), 1);
  viewer.key("ctrl+z");
  viewer.untilValue("sspm.objects", "1");
  viewer.key("ctrl+z");
  viewer.untilValue("sspm.objects", "0");
  viewer.key("ctrl+shift+z");
  viewer.untilValue("sspm.objects", "1");
  viewer.click("sspm.clear");
  viewer.untilValue("sspm.objects", "0");
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
