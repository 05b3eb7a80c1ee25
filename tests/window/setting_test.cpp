// SPDX-License-Identifier: MIT
// Settings: dragged, typed, reset, undone, compared, saved and copied.
#include "tests/window/window_test.h"

#include <algorithm>

namespace grisaille::tests {
namespace {

using SettingTest = WindowTest;
GRISAILLE_IN_WINDOWS(SettingTest);

TEST_P(SettingTest, ADraggedSliderIsTheRenderedSetting) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--view", "ssao.ao"}));
  viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.7, 0.5));
  viewer.untilChanged("ssao.radius", "0.5");
  const std::string radius = viewer.value("ssao.radius");
  const std::string shown = viewer.savePicture();
  std::vector<std::string> render = {"render",
                                     "--backend",
                                     GetParam(),
                                     "--set",
                                     "ssao.kernel_size=6",
                                     "--set",
                                     "ssao.radius=" + radius,
                                     "--write",
                                     "ao=rendered.exr"};
  const auto more = view(viewer);
  render.insert(render.end(), more.begin(), more.end());
  const Outcome outcome = runProgram(render, folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expectSame(shown, folder_ / "rendered.exr");
  // It differs from the picture with the previous setting.
  viewer.key("ctrl+z");
  viewer.untilValue("ssao.radius", "0.5");
  EXPECT_GT(image::compare(image::read(viewer.savePicture()), image::read(shown)).rmse, 0.001);
  viewer.key("ctrl+shift+z");
  viewer.untilValue("ssao.radius", radius);
  expectQuits(viewer);
}

// Even within one second: file names contain the second.
TEST_P(SettingTest, APictureSavedReplacesNone) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--view", "ssao.ao"}));
  for (int i = 0; i < 4; ++i) viewer.savePicture();
  const std::vector<std::string> files = folder_.files();
  for (const std::string ending : {".png", ".exr"}) {
    EXPECT_EQ(std::ranges::count_if(files, [&](const auto& f) { return f.ends_with(ending); }), 4);
  }
  expectQuits(viewer);
}

TEST_P(SettingTest, ValuesAreTypedAndCheckedAndReset) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}));
  const auto type = [&](const std::string& control, const std::string& text) {
    const Point at = viewer.middle(control);
    viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) +
                " keydown ctrl click 1 keyup ctrl");
    viewer.untilDrawn();
    viewer.type("'" + text + "'");
    viewer.key("Return");
  };
  type("ssao.radius", "0.8125");
  viewer.untilValue("ssao.radius", "0.8125");
  // Beyond the slider, within the hard range.
  type("ssao.radius", "123.5");
  viewer.untilValue("ssao.radius", "123.5");
  type("ssao.radius", "1e30");
  viewer.until("error 3302", [](const nlohmann::json& now) {
    return now.contains("message") &&
           now["message"]["value"].get<std::string>().find("3302") != std::string::npos;
  });
  EXPECT_EQ(viewer.value("ssao.radius"), "123.5");
  viewer.click("ssao.radius", 3);
  viewer.untilValue("ssao.radius", "0.5");
  expectQuits(viewer);
}

TEST_P(SettingTest, TheCopiedCommandMakesThePicture) {
  DrivenViewer viewer(folder_,
                      arguments({"--effects", "ssao,sspm", "--set", "sspm.paint_range=1"}));
  viewer.key("space");
  viewer.untilValue("sspm.objects", "1");
  viewer.drag(viewer.at("picture", 0.5, 0.5), viewer.at("picture", 0.6, 0.45));
  viewer.key("b");
  viewer.untilValue("sspm.placing", "true");
  viewer.click(viewer.at("picture", 0.3, 0.6));
  viewer.untilValue("sspm.objects", "2");
  const std::string shown = viewer.savePicture();
  viewer.key("ctrl+c");
  viewer.until("a command", [](const nlohmann::json& now) {
    return now["message"]["value"].get<std::string>().starts_with("grisaille render");
  });
  std::string command = viewer.value("message");
  const size_t file = command.rfind("grisaille.png");
  ASSERT_NE(file, std::string::npos) << command;
  command.replace(file, 13, "copied.exr");
  const Outcome outcome = runShell(command, folder_.path());
  ASSERT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  expectSame(shown, folder_ / "copied.exr");
  expectQuits(viewer);
}

TEST_P(SettingTest, WhatIsSavedComesBack) {
  std::string before;
  {
    DrivenViewer viewer(folder_,
                        arguments({"--effects", "ssao,sspm", "--set", "sspm.paint_range=1"}));
    viewer.drag(viewer.at("ssao.intensity", 0.5, 0.5), viewer.at("ssao.intensity", 0.9, 0.5));
    viewer.click("sspm.down");
    viewer.click("base");
    viewer.untilValue("base", "true");
    viewer.click("transparent");
    viewer.untilValue("background", "transparent");
    viewer.key("Escape space");
    viewer.untilValue("sspm.objects", "1");
    before = viewer.savePicture();
    viewer.key("ctrl+s");
    viewer.until("settings", [](const nlohmann::json& now) {
      return now["message"]["value"].get<std::string>().starts_with("settings to");
    });
    viewer.click("section View");  // makes room
    viewer.untilValue("section View", "closed");
    viewer.click("sspm.save");
    viewer.until("shots", [](const nlohmann::json& now) {
      return now["message"]["value"].get<std::string>().starts_with("1 shots to");
    });
    viewer.click("section View");
    viewer.untilValue("section View", "open");
    expectQuits(viewer);
  }
  DrivenViewer viewer(folder_,
                      {"--backend", GetParam(), "--size", kWindow, "--config", "settings.toml"});
  EXPECT_EQ(viewer.value("base"), "true");
  EXPECT_EQ(viewer.value("background"), "transparent");
  viewer.click("section View");
  viewer.untilValue("section View", "closed");
  viewer.click("sspm.load");
  viewer.untilValue("sspm.objects", "1");
  expectSame(viewer.savePicture(), before);
  expectQuits(viewer);
}

TEST_P(SettingTest, TwoSidesShowTwoSettings) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}));
  viewer.key("x");
  viewer.untilValue("split", "true");
  viewer.untilValue("view right", "normal");
  viewer.click("hold");
  viewer.untilThere("swap");
  viewer.drag(viewer.at("picture", 0.5, 0.5), viewer.at("picture", 0.25, 0.5));
  viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.8, 0.5));
  viewer.untilChanged("ssao.radius", "0.5");
  const std::string radius = viewer.value("ssao.radius");
  viewer.click("swap");
  viewer.untilValue("ssao.radius", "0.5");
  viewer.click("swap");
  viewer.untilValue("ssao.radius", radius);
  viewer.click("let go");
  viewer.until("no held settings", [](const nlohmann::json& now) { return !now.contains("swap"); });
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
