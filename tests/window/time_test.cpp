// SPDX-License-Identifier: MIT
// Scenes that move in the viewer: the time line, playing, and what follows the pose.
#include <cmath>

#include "app/viewer/session.h"
#include "tests/support/animated_gltf.h"
#include "tests/support/expect_error.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class TimeTest : public WindowTest {
 protected:
  TimeTest() { folder_.write("a.glb", animatedGlb()); }

  std::vector<std::string> viewer(std::vector<std::string> more) const {
    more.insert(more.begin(), {"a.glb", "--backend", GetParam(), "--size", kWindow, "--effects",
                               "ssao", "--set", "ssao.kernel_size=6", "--set", "ssao.radius=0.3"});
    return more;
  }
  static bool is(const nlohmann::json& layout, const std::string& control,
                 const std::string& value) {
    return layout.contains(control) && layout[control]["value"] == value;
  }
  // The picture of `grisaille render` with the viewer's camera.
  std::string rendered(const DrivenViewer& viewer, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "a.glb", "--backend", GetParam(), "--effects", "ssao",
                               "--write", "depth=r.exr"});
    const auto seen = view(viewer);
    more.insert(more.end(), seen.begin(), seen.end());
    const Outcome outcome = runProgram(more, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder_ / "r.exr";
  }
};
GRISAILLE_IN_WINDOWS(TimeTest);

TEST_P(TimeTest, ThePictureIsThatOfTheTimeLine) {
  DrivenViewer driven(folder_, viewer({"--view", "depth", "--animation", "move", "--time", "0.5"}));
  EXPECT_EQ(driven.value("animation"), "0");
  EXPECT_EQ(driven.value("time"), "0.5");
  const std::string first = driven.savePicture();
  expectSame(first, rendered(driven, {"--time", "0.5"}));
  // Its home is the camera that `grisaille render` chooses for a picture of this shape.
  const std::vector<std::string> seen = view(driven);
  const Outcome chosen =
      runProgram({"render", "a.glb", "--backend", GetParam(), "--effects", "ssao", "--time", "0.5",
                  seen[2], seen[3], "--write", "depth=chosen.exr"},
                 folder_.path());
  ASSERT_EQ(chosen.status, 0) << chosen.err;
  expectSame(first, folder_ / "chosen.exr");

  driven.key("period");
  driven.untilChanged("time", "0.5");
  EXPECT_NEAR(std::stod(driven.value("time")), 13.0 / 24, 1e-9);
  expectSame(driven.savePicture(), rendered(driven, {"--time", driven.value("time")}));

  driven.drag(driven.at("time", 0.3, 0.5), driven.at("time", 0.8, 0.5));
  driven.until("the time of the drag's end", [](const nlohmann::json& now) {
    return std::stod(now["time"]["value"].get<std::string>()) > 1.4;
  });
  driven.untilDrawn();
  const double dragged = std::stod(driven.value("time"));
  EXPECT_GT(dragged, 1.4);
  EXPECT_LT(dragged, 2);
  const std::string moved = driven.savePicture();
  expectSame(moved, rendered(driven, {"--time", driven.value("time")}));
  EXPECT_GT(image::compare(image::read(moved), image::read(first)).rmse, 0.001);

  const std::string before = driven.value("message");
  driven.key("ctrl+c");
  driven.untilChanged("message", before);
  EXPECT_NE(driven.value("message").find("--animation 0 --time " + driven.value("time")),
            std::string::npos)
      << driven.value("message");
  driven.click("animation");
  driven.untilThere("animation.rest");
  driven.click("animation.rest");
  driven.untilValue("animation", "rest");
  expectSame(driven.savePicture(), rendered(driven, {}));
  expectQuits(driven);
}

TEST_P(TimeTest, PlaysUntilItIsPaused) {
  DrivenViewer driven(folder_, viewer({"--view", "ssao.ao"}));
  EXPECT_EQ(driven.value("animation"), "rest");
  driven.key("k");
  const auto goesOn = [&] {
    const std::string before = driven.value("time");
    driven.until("another time", [&](const nlohmann::json& now) {
      return is(now, "playing", "true") && !is(now, "time", before);
    });
  };
  for (int i = 0; i < 5; ++i) goesOn();
  EXPECT_EQ(driven.value("animation"), "0");
  driven.key("k");
  driven.untilValue("playing", "false");
  // While nothing moves, the viewer draws nothing.
  const std::string drawn = driven.value("drawn"), time = driven.value("time");
  driven.send("sleep 1");
  EXPECT_EQ(driven.value("drawn"), drawn);
  EXPECT_EQ(driven.value("time"), time);
  driven.click("play");
  driven.until("playing", [](const auto& now) { return is(now, "playing", "true"); });
  goesOn();
  driven.key("comma");
  driven.untilValue("playing", "false");
  expectQuits(driven);
}

// The error on the screen is that against the truth of the pose.
TEST_P(TimeTest, TruthFollowsThePose) {
  const std::vector<std::string> cache = {"XDG_CACHE_HOME=" + (folder_ / "cache")};
  DrivenViewer driven(
      folder_,
      viewer({"--compare-truth", "--truth-rays", "24", "--view", "truth", "--time", "0.5"}), cache);
  driven.untilValue("truth", "done");
  const std::string before = driven.value("rmse");
  for (int i = 0; i < 6; ++i) driven.key("period");
  driven.until("the time", [](const auto& now) { return is(now, "time", "0.75"); });
  driven.untilValue("truth", "done");
  EXPECT_NE(driven.value("rmse"), before);
  const std::string shown = driven.savePicture();
  std::vector<std::string> truth = {
      "truth",     "a.glb", "--time",     "0.75",    "--radius", driven.value("truth radius"),
      "--samples", "24",    "--no-cache", "--write", "ao=t.exr"};
  const auto seen = view(driven);
  truth.insert(truth.end(), seen.begin(), seen.end());
  const Outcome outcome = runProgram(truth, folder_.path(), cache);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const image::Image a = image::read(shown), b = image::read(folder_ / "t.exr");
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  size_t different = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) different += a.pixels[i] != b.pixels[i];
  // The tracer's origin is the camera of its first view: a ray in a thousand rounds differently.
  EXPECT_LT(different, a.pixels.size() / 100);
  expectQuits(driven);
}

class SessionTime : public ::testing::Test {
 protected:
  static app::viewer::SessionOptions options() {
    app::viewer::SessionOptions options;
    options.effects = {"ssao", "sspm"};
    options.effectsGiven = true;
    options.pluginPaths = {EFFECTS_FOLDER};
    return options;
  }
  void open(app::viewer::Session& session) {
    const std::string path = folder_.write("a.glb", animatedGlb());
    session.setScene(std::make_shared<scene::Scene>(scene::loadGltf(path)), path, {64, 36});
  }

  TemporaryFolder folder_;
};

TEST_F(SessionTime, LoopsAndSteps) {
  app::viewer::Session session(options());
  session.play(true);  // no scene yet
  session.stepFrames(1);
  open(session);
  EXPECT_FALSE(session.isPlaying());
  session.advance(1);
  EXPECT_EQ(session.playback.pose, scene::Pose());
  session.play(true);
  EXPECT_EQ(session.playback.pose, (scene::Pose{.animation = 0, .seconds = 0}));
  session.advance(0.75);
  EXPECT_DOUBLE_EQ(session.playback.pose.seconds, 0.75);
  session.playback.speed = 2;
  session.advance(1);
  EXPECT_NEAR(session.playback.pose.seconds, 0.75, 1e-9);  // 2 s later, at the same place
  session.paused = true;
  session.advance(0.1);
  EXPECT_NEAR(session.playback.pose.seconds, 0.75, 1e-9);
  session.paused = false;
  session.stepFrames(1);
  EXPECT_FALSE(session.isPlaying());
  EXPECT_EQ(session.frameNumber(), 19);
  session.seek(100);
  EXPECT_EQ(session.playback.pose.seconds, 2);
  session.stepFrames(1);
  EXPECT_EQ(session.frameNumber(), 0);
  session.stepFrames(-1);
  EXPECT_EQ(session.frameNumber(), 48);
  const std::string command = session.commandLine({64, 36}, "", "");
  EXPECT_NE(command.find("--animation 0 --time 2 "), std::string::npos) << command;
  open(session);
  EXPECT_EQ(session.playback.pose, scene::Pose());
  EXPECT_EQ(session.commandLine({64, 36}, "", "").find("--time"), std::string::npos);
}

TEST_F(SessionTime, TheFirstSceneTakesThePoseOfTheCommandLine) {
  app::viewer::SessionOptions given = options();
  given.pose = {.animation = "jump", .time = 0.5};
  app::viewer::Session session(given);
  open(session);
  EXPECT_EQ(session.playback.pose, (scene::Pose{.animation = 1, .seconds = 0.5}));
  EXPECT_NE(session.rescue(folder_.path() / "rescued").find("--animation 1 --time 0.5 "),
            std::string::npos);
  given.pose.time = 5;
  app::viewer::Session late(given);
  open(late);
  EXPECT_NE(late.messages.back().text.find("E2107"), std::string::npos);
  EXPECT_EQ(late.playback.pose, scene::Pose());
}

// Objects land on the surfaces of the pose.
TEST_F(SessionTime, PlacementFollowsThePose) {
  app::viewer::Session session(options());
  open(session);
  // Down onto the place that the box reaches after 1 s.
  const std::vector<grisaille_ray> down = {
      {.origin = {-1.5, 5, 1.5}, .direction = {0, -1, 0}, .reach = 10}};
  std::vector<grisaille_hit> hit(1);
  session.services->rays().cast(down, hit);
  const float before = hit[0].distance;
  session.takePose({.animation = 0, .seconds = 1});
  session.services->rays().cast(down, hit);
  EXPECT_LT(hit[0].distance, before - 0.5f);
  session.takePose({});
  session.services->rays().cast(down, hit);
  EXPECT_EQ(hit[0].distance, before);
}

}  // namespace
}  // namespace grisaille::tests
