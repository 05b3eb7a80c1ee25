// SPDX-License-Identifier: MIT
// Data that the viewer hands to `grisaille render`: settings files, cameras as text, whole command
// lines.
#include <gtest/gtest.h>

#include "app/settings/load_effects.h"
#include "app/settings/settings.h"
#include "app/viewer/command_line.h"
#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class Settings : public ::testing::Test {
 protected:
  std::vector<float> render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "--size", "96x54", "--write", "color=c.exr"});
    const Outcome outcome = runProgram(arguments, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return picture("c.exr");
  }
  std::vector<float> picture(const std::string& name) {
    std::vector<float> pixels = image::read(folder_ / name).pixels;
    std::filesystem::remove(folder_ / name);
    return pixels;
  }

  TemporaryFolder folder_;
  // The program's own effects, from the folder beside the program.
  std::unique_ptr<effect::Registry> registry_ = app::loadEffects({});
  effect::Selection list_{*registry_};
  const scene::Camera camera_{
      .eye = {8.1, 1.7, -3.3}, .target = {-6.1, 1.0 / 3, -3.9}, .fovyDegrees = 61.7};
};

TEST_F(Settings, ACameraAsTextIsTheCameraOfAFile) {
  scene::saveCamera(camera_, folder_ / "camera.json");
  const auto fromFile = render({"--camera", "camera.json"});
  EXPECT_EQ(render({"--camera", scene::cameraJson(camera_)}), fromFile);
  EXPECT_NE(render({}), fromFile);
}

TEST_F(Settings, AWrittenFileMakesThePictureOfItsOptions) {
  ASSERT_NE(list_.find("ssao"), nullptr);
  list_.find("ssao")->on = true;
  list_.find("ssao")->values.set("radius", 1.0 / 3);
  list_.find("ssao")->values.set("blur", "edge_aware");
  app::Settings settings = app::settingsOf(list_);
  settings.surface = "base";
  app::writeSettings(settings, folder_ / "a.toml");
  const auto given = render({"--set", "ssao.radius=0.3333333333333333", "--set",
                             "ssao.blur=edge_aware", "--surface", "base"});
  EXPECT_EQ(render({"--config", "a.toml"}), given);
  // Options on the command line override the file.
  EXPECT_EQ(render({"--config", "a.toml", "--surface", "white", "--set", "ssao.radius=0.5", "--set",
                    "ssao.blur=box"}),
            render({}));
}

TEST_F(Settings, ACommandLineMakesThePictureOfOptionsByHand) {
  for (const char* key : {"sspm", "ssao"}) list_.find(key)->on = true;
  list_.move(1, 0);  // sspm first
  ASSERT_STREQ(list_.entries()[0].key(), "sspm");
  list_.find("ssao")->values.set("intensity", 1.25);
  list_.find("sspm")->values.set("paint_range", 1.0);
  const auto added = render({"--effects", "sspm", "--add", "sspm=40,25,color=#ff0000", "--add",
                             "sspm=60,20,color=#00ff00", "--save", "sspm=it's my $HOME.json"});
  std::filesystem::create_directory(folder_ / "-plug ins");
  scene::saveCamera(camera_, folder_ / "camera.json");
  const auto byHand = render({"--camera", "camera.json", "--effects", "sspm,ssao", "--set",
                              "ssao.intensity=1.25", "--set", "sspm.paint_range=1", "--surface",
                              "base", "--load", "sspm=it's my $HOME.json"});
  app::viewer::RenderCommand command;
  command.camera = camera_;
  command.size = {96, 54};
  command.effects = &list_;
  command.surface = "base";
  command.pluginPaths = {"-plug ins"};
  command.loads = {{"sspm", "it's my $HOME.json"}};
  command.writes = {{"color", "a \"b\" `c`.exr"}};
  const Outcome outcome = runShell(app::viewer::renderCommand(command), folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(picture("a \"b\" `c`.exr"), byHand);
  EXPECT_NE(byHand, added);
  EXPECT_NE(byHand, render({"--camera", "camera.json", "--surface", "base"}));
}

TEST_F(Settings, ACommandLineNamesSceneBackendAndNoEffects) {
  ASSERT_EQ(runProgram({"scene", "--write", "-my scene.glb"}, folder_.path()).status, 0);
  std::string backend;
  for (const char* name : {"opengl", "vulkan"}) {
    const Outcome outcome = runProgram(
        {"render", "--size", "8x8", "--backend", name, "--write", "depth=d.exr"}, folder_.path());
    if (outcome.status == 0) backend = name;
  }
  app::viewer::RenderCommand command;
  command.scene = "-my scene.glb";
  command.camera = camera_;
  command.size = {96, 54};
  command.backend = backend;
  command.device = "0";
  command.effects = &list_;  // all off
  command.writes = {{"color", "a.exr"}};
  const Outcome outcome = runShell(app::viewer::renderCommand(command), folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind(backend + ": ", 0), 0u) << outcome.out;
  EXPECT_EQ(picture("a.exr"), render({"--camera", scene::cameraJson(camera_), "--backend", backend,
                                      "--effects", ""}));
}

}  // namespace
}  // namespace grisaille::tests
