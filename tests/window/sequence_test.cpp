// SPDX-License-Identifier: MIT
// A path of cameras in the viewer: recorded, moved along, and rendered to numbered files.
#include <fmt/format.h>

#include <cstdlib>

#include "tests/support/animated_gltf.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

using SequenceTest = WindowTest;
GRISAILLE_IN_WINDOWS(SequenceTest);

TEST_P(SequenceTest, APathIsRecordedAndRendered) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--view", "depth"}));
  openOnly(viewer, "section Sequence");
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

// ffmpeg is a stand-in, which writes down what it is given.
TEST_P(SequenceTest, AVideoIsMadeOfThePictures) {
  namespace fs = std::filesystem;
  folder_.write("ffmpeg",
                "#!/bin/sh\n[ -e fail ] && echo 'no such codec' >&2 && exit 1\n"
                "printf '%s\\n' \"$@\" > given\nfor last; do :; done\n"
                "echo video > \"${last#file:}\"\n");
  fs::permissions(folder_ / "ffmpeg", fs::perms::owner_all);
  DrivenViewer viewer(folder_, arguments({"carving", "--effects", "ssao"}),
                      {"PATH=" + folder_.path().string() + ":" + std::getenv("PATH")});
  openOnly(viewer, "section Sequence");
  viewer.click("path add");
  viewer.untilValue("path bookmark", "1");
  const std::string first = viewer.value("camera");
  viewer.key("Escape Right");
  viewer.untilChanged("camera", first);
  viewer.click("path add");
  viewer.untilValue("path bookmark", "2");
  fill(viewer, "sequence seconds", "0.125");
  fill(viewer, "sequence file", "a b.##.png");
  viewer.click("sequence filmed");
  viewer.untilValue("sequence filmed", "true");
  fill(viewer, "sequence video", "a b.mp4");
  const auto render = [&](const std::string& end) {
    viewer.click("sequence render");
    viewer.until(end, [&](const nlohmann::json& now) {
      const char* name = end.starts_with("error") ? "error" : "message";
      return now.contains(name) &&
             now[name]["value"].get<std::string>().find(end) != std::string::npos;
    });
    viewer.untilThere("sequence render");
  };
  folder_.write("fail", "");
  render("error E5513: a b.mp4: ffmpeg fails: no such codec");
  EXPECT_FALSE(fs::exists(folder_ / "a b.mp4"));
  EXPECT_TRUE(fs::exists(folder_ / "a b.03.png"));
  fs::remove(folder_ / "fail");
  render("is written: a b.mp4");
  EXPECT_EQ(viewer.value("error"), "");
  EXPECT_EQ(readFile(folder_ / "a b.mp4"), "video\n");
  const std::string given = readFile(folder_ / "given");
  EXPECT_NE(given.find("-framerate\n24\n"), std::string::npos) << given;
  EXPECT_NE(given.find("-i\nfile:a b.%02d.png\n-frames:v\n4\n"), std::string::npos) << given;
  for (const std::string& file : folder_.files()) {
    EXPECT_EQ(file.find(".part"), std::string::npos) << file;
  }
  expectQuits(viewer);
}

// The camera rests; the animation plays once.
TEST_P(SequenceTest, AnAnimationIsRenderedAndCancelled) {
  // Renders two minutes of animation: a busy machine writes the pictures of two seconds before the
  // click on Cancel arrives.
  folder_.write("a.glb", animatedGlb(60));
  DrivenViewer viewer(folder_, {"a.glb", "--backend", GetParam(), "--size", kWindow, "--effects",
                                "ssao", "--view", "depth", "--set", "ssao.radius=0.3"});
  openOnly(viewer, "section Sequence");
  viewer.click("sequence animated");
  viewer.untilValue("sequence animated", "true");
  EXPECT_EQ(viewer.value("sequence frames"), "2881");
  fill(viewer, "sequence file", "run.####.exr");
  viewer.click("sequence render");
  viewer.untilThere("sequence cancel");
  viewer.until("the first frames", [&](const nlohmann::json&) {
    return std::filesystem::exists(folder_ / "run.0002.exr");
  });
  viewer.click("sequence cancel");
  viewer.untilThere("sequence render");
  EXPECT_NE(viewer.value("error").find("cancelled"), std::string::npos) << viewer.value("error");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run.2880.exr"));
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
