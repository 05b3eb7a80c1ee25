// SPDX-License-Identifier: MIT
// docs/manual/view_tasks.md, step by step, with nothing but its text: painting, and comparing two
// backends. Other tests run the page's commands.
#include <fmt/format.h>

#include <filesystem>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

using TasksTest = WindowTest;
GRISAILLE_IN_WINDOWS(TasksTest);

TEST_P(TasksTest, Paint) {
  DrivenViewer viewer(folder_, arguments());
  // 1. Under Effects, tick Paint (sspm).
  EXPECT_EQ(viewer.value("sspm.on"), "false");
  viewer.click("sspm.on");
  viewer.untilValue("sspm.on", "true");
  // 2. Press B: the left button now shoots paint. Click in the picture, or hold the button to
  // spray.
  viewer.key("Escape b");
  viewer.click(viewer.at("picture", 0.3, 0.5));
  viewer.untilDrawn();
  const std::string camera = viewer.value("camera");
  // 3. Open the section Objects and choose the Colour of the next shots.
  openOnly(viewer, "section Objects");
  viewer.untilValue("sspm.objects", "1");
  EXPECT_EQ(viewer.value("sspm.placing"), "true");
  fill(viewer, "sspm.next.color", "#0000ff");
  const Point second = viewer.at("picture", 0.7, 0.5);
  viewer.click(second);
  viewer.untilValue("sspm.objects", "2");
  // 4. To move a shot, hold Ctrl and drag it. Delete deletes it. Ctrl+Z takes the last step back.
  const Point to = viewer.at("picture", 0.6, 0.7);
  viewer.send(fmt::format("mousemove {} {} keydown ctrl mousedown 1", second.x, second.y));
  viewer.untilDrawn();
  viewer.send(fmt::format("mousemove {} {}", (second.x + to.x) / 2, (second.y + to.y) / 2));
  viewer.untilDrawn();
  viewer.send(fmt::format("mousemove {} {}", to.x, to.y));
  viewer.untilDrawn();
  viewer.send("mouseup 1 keyup ctrl");
  viewer.untilDrawn();
  EXPECT_NEAR(viewer.middle("selected").x, to.x, 3);
  EXPECT_NEAR(viewer.middle("selected").y, to.y, 3);
  viewer.key("Delete");
  viewer.untilValue("sspm.objects", "1");
  viewer.key("ctrl+z");
  viewer.untilValue("sspm.objects", "2");
  EXPECT_EQ(viewer.value("camera"), camera);
  // 5. Press B again to orbit. Press Save under the list to keep the shots in a file.
  viewer.key("b");
  viewer.untilValue("sspm.placing", "false");
  viewer.click("sspm.save");
  viewer.until("the file", [&](const nlohmann::json&) {
    return std::filesystem::exists(folder_ / "sspm.json");
  });
  const auto saved = nlohmann::json::parse(readFile(folder_ / "sspm.json"));
  ASSERT_EQ(saved["shots"].size(), 2u);
  const auto blue = saved["shots"][1]["color"].get<std::vector<double>>();
  EXPECT_EQ(blue[0], 0) << saved.dump();
  EXPECT_GT(blue[2], 0.99) << saved.dump();
  EXPECT_GT(saved["shots"][0]["color"][0], 0.9) << saved.dump();
  viewer.drag(viewer.at("picture", 0.4, 0.4), viewer.at("picture", 0.5, 0.42));
  viewer.untilChanged("camera", camera);
  EXPECT_EQ(viewer.value("sspm.objects"), "2");
  expectQuits(viewer);
}

TEST_P(TasksTest, CompareTwoBackends) {
  DrivenViewer viewer(folder_, arguments());
  const std::string other = GetParam() == "opengl" ? "vulkan" : "opengl";
  // 1. Press X to split the picture.
  viewer.key("x");
  viewer.untilValue("split", "true");
  // 2. Under View choose ssao.ao, and the same under Right side.
  choose(viewer, "view", "ssao.ao");
  viewer.untilValue("view", "ssao.ao");
  choose(viewer, "view right", "ssao.ao");
  viewer.untilValue("view right", "ssao.ao");
  // 3. Under Its backend choose the other backend. The labels in the picture name both.
  choose(viewer, "right backend", other);
  viewer.untilValue("right backend", other);
  const auto named = [&](const char* side, const std::string& backend) {
    return viewer.value(std::string("label ") + side)
               .find(backend == "opengl" ? "OpenGL" : "Vulkan") != std::string::npos;
  };
  EXPECT_TRUE(named("left", GetParam())) << viewer.value("label left");
  EXPECT_TRUE(named("right", other)) << viewer.value("label right");
  // 4. The bottom of the panel shows the RMSE and the largest difference. Press Shift+X to see the
  // differences.
  const std::string numbers = viewer.value("split numbers");
  EXPECT_NE(numbers.find("RMSE "), std::string::npos) << numbers;
  EXPECT_NE(numbers.find("largest difference "), std::string::npos) << numbers;
  viewer.key("shift+x");
  viewer.untilValue("split way", "difference");
  viewer.untilThere("split legend");
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
