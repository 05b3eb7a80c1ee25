// SPDX-License-Identifier: MIT
#include "app/viewer/command_line.h"
#include "core/base/quote.h"

#include <cstdio>

#include <random>

#include "tests/support/folder_test.h"
#include "tests/support/selections.h"

namespace grisaille::app::viewer {
namespace {

using tests::randomise;
using tests::Tables;

class CommandLine : public tests::FolderTest {
 protected:
  // Splits a line into words with a shell.
  std::vector<std::string> split(const std::string& line, const std::string& shell = "bash") const {
    const std::string script = fileOf("script", "printf '%s\\0' " + line);
    FILE* pipe = popen((shell + " '" + script + "'").c_str(), "r");
    std::string all;
    for (int c = 0; pipe != nullptr && (c = std::fgetc(pipe)) != EOF;) {
      all += static_cast<char>(c);
    }
    EXPECT_TRUE(pipe != nullptr && pclose(pipe) == 0) << line;
    std::vector<std::string> words;
    for (size_t at = 0; at < all.size();) {
      const size_t end = all.find('\0', at);
      words.push_back(all.substr(at, end - at));
      at = end + 1;
    }
    return words;
  }
};

std::string nasty(std::mt19937_64& random) {
  static const std::string kLetters =
      " '\"\\$`!*?[]{}()<>|&;#~=%^\n\t\r-/.,:@+_aZ0\x01\x7f\xff\xc3\xa4";
  std::string text;
  for (size_t i = random() % 12; i > 0; --i) text += kLetters[random() % kLetters.size()];
  return text;
}

TEST_F(CommandLine, AShellSplitsItIntoWhatWentIn) {
  std::mt19937_64 random(1);
  std::vector<std::string> words = {"",   "'",     "''",   "a'b",   "$HOME", "~",  "~/a", "*",
                                    "-n", "!!",    "a b",  "\\",    "\\'",   "\n", "#a",  "a=b",
                                    "%s", "$(ls)", "`ls`", "{a,b}", "&&",    ";",  "\t",  "a\\"};
  for (int i = 0; i < 3000; ++i) words.push_back(nasty(random));
  std::string line;
  for (const std::string& word : words) line += " " + shellQuoted(word);
  EXPECT_EQ(split(line), words);
  EXPECT_EQ(split(line, "sh"), words);
  EXPECT_EQ(shellQuoted("color=a/b-1.png"), "color=a/b-1.png");  // no quotes where none are needed
}

TEST_F(CommandLine, WholeCommandsSurviveAShell) {
  const Tables tables;
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    effect::Selection list(tables.registry);
    randomise(random, list);
    RenderCommand command;
    command.scene = nasty(random);
    command.backend = nasty(random);
    command.device = nasty(random);
    command.effects = random() % 8 == 0 ? nullptr : &list;
    command.loads = {{"alpha", nasty(random)}};
    command.writes = {{"color", nasty(random)}, {"depth", nasty(random)}};
    command.pluginPaths = {nasty(random)};
    ASSERT_EQ(split(renderCommand(command)), renderArguments(command));
  }
}

TEST_F(CommandLine, SaysWhatIsSetAndNothingElse) {
  const Tables tables;
  effect::Selection list(tables.registry);
  list.move(2, 0);
  for (const char* key : {"gamma", "beta"}) list.find(key)->on = true;
  list.find("beta")->values.set("amount", 0.1);
  list.find("beta")->values.set("kind", "first");
  list.find("alpha")->values.set("count", 9.0);  // off
  const scene::Camera camera{
      .eye = {1, 2, 3}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fovyDegrees = 50, .size = {9, 9}};
  RenderCommand command;
  command.camera = camera;
  command.size = {640, 360};
  command.effects = &list;
  EXPECT_EQ(renderCommand(command),
            "grisaille render --camera "
            "'{\"eye\":[1.0,2.0,3.0],\"target\":[0.0,0.0,0.0],\"up\":[0.0,1.0,0.0],"
            "\"fovy_degrees\":50.0,\"near\":0.01}' --size 640x360 --effects gamma,beta "
            "--set beta.amount=0.1 --set beta.kind=first --surface white");
  command.scene = "-a scene.glb";
  command.backend = "vulkan";
  command.device = "llvmpipe (LLVM)";
  command.effects = nullptr;
  command.surface = "base";
  command.background = "transparent";
  command.pluginPaths = {"/plugins", "-"};
  command.loads = {{"sspm", "my shots.json"}};
  command.writes = {{"color", "a.png"}, {"ssao.ao", "ao.exr"}};
  EXPECT_EQ(
      renderCommand(command),
      "grisaille render './-a scene.glb' --camera "
      "'{\"eye\":[1.0,2.0,3.0],\"target\":[0.0,0.0,0.0],\"up\":[0.0,1.0,0.0],"
      "\"fovy_degrees\":50.0,\"near\":0.01}' --size 640x360 --backend vulkan "
      "--device 'llvmpipe (LLVM)' --plugin-path /plugins --plugin-path ./- --effects '' "
      "--surface base --background transparent --load 'sspm=my shots.json' --write color=a.png "
      "--write ssao.ao=ao.exr");
}

}  // namespace
}  // namespace grisaille::app::viewer
