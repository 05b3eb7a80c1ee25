// SPDX-License-Identifier: MIT
// A path of cameras in the viewer: recorded, moved along, and rendered to numbered files.
#include <fmt/format.h>

#include "tests/support/animated_gltf.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class SequenceTest : public WindowTest {
 protected:
  // Only the section of the sequence is open.
  static void makeRoom(DrivenViewer& viewer) {
    for (const char* section : {"section Effects", "section View", "section Objects"}) {
      if (viewer.value(section) != "open") continue;
      viewer.click(section);
      viewer.untilValue(section, "closed");
    }
    viewer.click("section Sequence");
    viewer.untilValue("section Sequence", "open");
  }
  static void fill(DrivenViewer& viewer, const std::string& field, const std::string& text) {
    viewer.clickText(field);
    viewer.key("ctrl+a");
    viewer.type(text);
    viewer.key("Return");
    viewer.untilValue(field, text);
  }
};
GRISAILLE_IN_WINDOWS(SequenceTest);

TEST_P(SequenceTest, APathIsRecordedAndRendered) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--view", "depth"}));
  makeRoom(viewer);
  const std::string first = viewer.value("camera");
  viewer.click("path add");
  viewer.untilValue("path bookmark", "1");
  // One camera is no path.
  viewer.click("sequence render");
  viewer.untilThere("error");
  EXPECT_NE(viewer.value("error").find("two cameras"), std::string::npos) << viewer.value("error");
  viewer.drag(viewer.at("picture", 0.5, 0.5), viewer.at("picture", 0.8, 0.52));
  viewer.untilChanged("camera", first);
  const std::string last = viewer.value("camera");
  viewer.click("path add");
  viewer.untilValue("path bookmark", "2");
  fill(viewer, "sequence seconds", "0.25");
  EXPECT_EQ(viewer.value("sequence frames"), "7");
  fill(viewer, "sequence file", "walk.##.exr");

  viewer.click("path.0");
  viewer.untilValue("camera", first);
  viewer.click("sequence preview");
  viewer.untilValue("camera", last);  // the preview ends at the last camera

  viewer.click("sequence render");
  viewer.until("the sequence", [](const nlohmann::json& now) {
    return now.contains("message") &&
           now["message"]["value"].get<std::string>().find("is written") != std::string::npos;
  });
  EXPECT_EQ(viewer.value("error"), "");
  for (int i = 0; i < 7; ++i) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / fmt::format("walk.{:02}.exr", i))) << i;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "walk.07.exr"));
  // The last picture is that of the screen, which shows the last camera.
  expectSame(viewer.savePicture(), folder_ / "walk.06.exr");
  EXPECT_GT(
      image::compare(image::read(folder_ / "walk.00.exr"), image::read(folder_ / "walk.06.exr"))
          .rmse,
      0.001);
  expectQuits(viewer);
}

// The camera rests; the animation plays once.
TEST_P(SequenceTest, AnAnimationIsRenderedAndCancelled) {
  folder_.write("a.glb", animatedGlb());
  DrivenViewer viewer(folder_, {"a.glb", "--backend", GetParam(), "--size", kWindow, "--effects",
                                "ssao", "--view", "depth", "--set", "ssao.radius=0.3"});
  makeRoom(viewer);
  viewer.click("sequence animated");
  viewer.untilValue("sequence animated", "true");
  EXPECT_EQ(viewer.value("sequence frames"), "49");
  fill(viewer, "sequence file", "run.##.exr");
  viewer.click("sequence render");
  viewer.untilThere("sequence cancel");
  viewer.until("the first frames", [&](const nlohmann::json&) {
    return std::filesystem::exists(folder_ / "run.02.exr");
  });
  viewer.click("sequence cancel");
  viewer.untilThere("sequence render");
  EXPECT_NE(viewer.value("error").find("cancelled"), std::string::npos) << viewer.value("error");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.48.exr"));
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
