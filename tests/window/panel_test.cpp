// SPDX-License-Identifier: MIT
// The panel shows what counts, whole, and stays as the user left it.
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class PanelTest : public WindowTest {
 protected:
  static std::vector<double> rectOf(const nlohmann::json& layout, const std::string& control) {
    return layout.at(control).at("rect").get<std::vector<double>>();
  }
};
GRISAILLE_IN_WINDOWS(PanelTest);

TEST_P(PanelTest, ParametersThatDoNothingAreFoldedWithTheReason) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--set", "ssao.bounce=albedo"}));
  EXPECT_EQ(viewer.value("ssao.albedo"), "0.8");
  EXPECT_EQ(viewer.value("ssao.albedo.reason"), "");
  viewer.click("ssao.bounce", 3);  // back to none
  viewer.untilValue("ssao.bounce", "none");
  EXPECT_EQ(viewer.value("ssao.albedo"), "");
  ASSERT_EQ(viewer.value("ssao.unused"), "closed");
  viewer.click(viewer.at("ssao.unused", 0.3, 0.5));
  viewer.untilThere("ssao.albedo");
  EXPECT_EQ(viewer.value("ssao.albedo.reason"), "used when bounce = albedo");
  // It can be set all the same, and keeps its value.
  viewer.drag(viewer.at("ssao.albedo", 0.3, 0.5), viewer.at("ssao.albedo", 0.5, 0.5));
  viewer.untilChanged("ssao.albedo", "0.8");
  viewer.key("Escape ctrl+z ctrl+z");
  viewer.until("albedo in use", [](const nlohmann::json& now) {
    return now.contains("ssao.albedo") && !now.contains("ssao.albedo.reason");
  });
  viewer.untilValue("ssao.albedo", "0.8");
  expectQuits(viewer);
}

TEST_P(PanelTest, WidthAndSectionsStayAsTheUserLeftThem) {
  double left = 0;
  {
    DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "900x1400", "--effects",
                                  "ssao", "--set", "ssao.kernel_size=2"});
    const double before = rectOf(viewer.layout(), "picture")[0];
    const Point from = viewer.middle("panel border");
    viewer.drag(from, {from.x + 120, from.y});
    left = rectOf(viewer.layout(), "picture")[0];
    EXPECT_NEAR(left, before + 120, 4);
    EXPECT_EQ(viewer.value("section View"), "open");
    viewer.click("section View");
    viewer.untilValue("section View", "closed");
    viewer.click("section Cost");
    viewer.untilValue("section Cost", "open");
    expectQuits(viewer);
  }
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "900x1400", "--effects", "ssao",
                                "--set", "ssao.kernel_size=2"});
  EXPECT_EQ(rectOf(viewer.layout(), "picture")[0], left);
  EXPECT_EQ(viewer.value("section View"), "closed");
  EXPECT_EQ(viewer.value("section Cost"), "open");
  EXPECT_EQ(viewer.value("section Effects"), "open");
  // As narrow as it gets, there still is a panel, and a picture at its widest.
  Point border = viewer.middle("panel border");
  viewer.drag(border, {2, border.y});
  border = viewer.middle("panel border");
  EXPECT_GT(border.x, 50);
  viewer.drag(border, {899, border.y});
  EXPECT_LE(rectOf(viewer.layout(), "panel border")[2], 900);
  expectQuits(viewer);
}

TEST_P(PanelTest, NamesAndTooltipsAreNotCut) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "480x900", "--effects", "moody",
                                "--plugin-path", MOODY, "--view", "moody.all"});
  const auto inside = [&](const std::string& control, double right) {
    const nlohmann::json now = viewer.layout();
    ASSERT_TRUE(now.contains(control)) << control;
    const auto rect = rectOf(now, control);
    EXPECT_GE(rect[0], 0) << control;
    EXPECT_GE(rect[1], 0) << control;
    EXPECT_LE(rect[2], right) << control;
    EXPECT_LE(rect[3], 900) << control;
    EXPECT_GT(rect[3] - rect[1], 10) << control;
  };
  const double width = rectOf(viewer.layout(), "picture")[0];
  inside("moody.patience.name", width);
  inside("moody.patience", width);
  const Point at = viewer.middle("moody.patience");
  viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y));
  viewer.until("a tooltip", [](const nlohmann::json& now) {
    return now.contains("tooltip") &&
           now["tooltip"]["value"].get<std::string>().find("patience") != std::string::npos;
  });
  viewer.untilDrawn();
  inside("tooltip", 480);
  // At the window's lower right corner, where the border is dragged to.
  const Point border = viewer.middle("panel border");
  viewer.drag(border, {478, border.y});
  viewer.send("mousemove " + std::to_string(viewer.at("moody.patience", 0.95, 0.5).x) + " " +
              std::to_string(viewer.at("moody.patience", 0.95, 0.5).y));
  viewer.untilThere("tooltip");
  inside("tooltip", 480);
  expectQuits(viewer);
}

// The numbers stay in sight while a slider is dragged, also in a low window.
TEST_P(PanelTest, TheErrorIsInSightWhileASliderIsDragged) {
  DrivenViewer viewer(folder_,
                      {"--backend", GetParam(), "--size", "640x480", "--effects", "ssao", "--set",
                       "ssao.kernel_size=2", "--compare-truth", "--truth-rays", "16"},
                      {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  viewer.untilThere("truth numbers");
  viewer.untilThere("error legend");
  viewer.untilThere("ssao.radius");
  for (const char* control : {"truth numbers", "error legend", "ssao.radius"}) {
    EXPECT_LE(rectOf(viewer.layout(), control)[3], 480) << control;
    EXPECT_LE(rectOf(viewer.layout(), control)[2], rectOf(viewer.layout(), "picture")[0]);
  }
  const std::string before = viewer.value("truth numbers");
  viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.7, 0.5));
  viewer.untilChanged("truth numbers", before);
  expectQuits(viewer);
}

TEST_P(PanelTest, CostIsAGraphAndAFileAndTheThemeStays) {
  {
    DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}));
    viewer.click("section View");
    viewer.untilValue("section View", "closed");
    viewer.click("section Cost");
    viewer.untilThere("save cost");
    EXPECT_NE(viewer.value("cost.frame"), "");
    EXPECT_NE(viewer.value("cost.sum of passes"), "");
    const auto graph = rectOf(viewer.layout(), "cost graph");
    EXPECT_GT(graph[2] - graph[0], 0.9 * rectOf(viewer.layout(), "picture")[0] - 40);
    viewer.click("save cost");
    viewer.until("a file", [](const nlohmann::json& now) {
      return now.contains("message") &&
             now["message"]["value"].get<std::string>().find("cost.csv") != std::string::npos;
    });
    const std::string message = viewer.value("message");
    EXPECT_TRUE(
        readFile(folder_ / message.substr(0, message.find(','))).starts_with("frame number,"));
    viewer.click("section Settings");
    viewer.untilThere("light theme");
    viewer.click("light theme");
    viewer.untilValue("light theme", "true");
    expectQuits(viewer);
  }
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}));
  EXPECT_EQ(viewer.value("light theme"), "true");
  EXPECT_GT(display_.pixels(2, 1670, 1, 1)[0] & 0xffu, 200u);  // the panel's ground
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
