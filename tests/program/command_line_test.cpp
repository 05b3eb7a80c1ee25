// SPDX-License-Identifier: MIT
// The command line: lists, options and errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

// Expects one error line with this number on standard error.
void expectError(const Outcome& outcome, int number, const std::string& mention = "") {
  EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status << outcome.err;
  EXPECT_EQ(outcome.err.rfind("error E" + std::to_string(number) + ": ", 0), 0u) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("; "), std::string::npos) << "no remedy in " << outcome.err;
  EXPECT_NE(outcome.err.find(mention), std::string::npos) << mention << " not in " << outcome.err;
}

class CommandLine : public ::testing::Test {
 protected:
  Outcome grisaille(const std::vector<std::string>& arguments) {
    return runProgram(arguments, folder_.path());
  }
  // Renders a tiny picture.
  Outcome render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "--size", "16x9"});
    return grisaille(arguments);
  }
  TemporaryFolder folder_;
};

TEST_F(CommandLine, HelpNamesEverySubcommandAndOption) {
  const Outcome help = grisaille({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"render", "effects", "backends", "scene", "completion"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
    EXPECT_EQ(grisaille({command, "--help"}).status, 0);
  }
  const std::string render = grisaille({"render", "--help"}).out;
  for (const char* option :
       {"--camera", "--size",   "--backend",  "--device",      "--effects", "--set",     "--config",
        "--write",  "--frames", "--timings",  "--plugin-path", "--check",   "--surface", "--load",
        "--add",    "--save",   "--coverage", "--animation",   "--time",    "--times"}) {
    EXPECT_NE(render.find(option), std::string::npos) << option;
  }
  EXPECT_EQ(grisaille({"--version"}).out, "0.1.0\n");
}

TEST_F(CommandLine, EffectsListsRangesUnitsAndDefaults) {
  const Outcome outcome = grisaille({"effects", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json["refused"].empty());
  const auto& effects = json["effects"];
  const auto ssao = std::find_if(effects.begin(), effects.end(),
                                 [](const auto& effect) { return effect["key"] == "ssao"; });
  ASSERT_NE(ssao, effects.end());
  for (const auto& param : (*ssao)["parameters"]) {
    if (param["key"] != "radius") continue;
    EXPECT_EQ(param["unit"], "m");
    EXPECT_EQ(param["scale"], "log");
    EXPECT_LT(param["hard_range"][0], param["default"]);
    EXPECT_GT(param["hard_range"][1], param["default"]);
  }
  EXPECT_NE(grisaille({"effects"}).out.find("kernel_size"), std::string::npos);
}

TEST_F(CommandLine, RefusedPluginsAreListedAndTheRestGoesOn) {
  folder_.write("broken.so", "not a library");
  const Outcome outcome = grisaille({"effects", "--json", "--plugin-path", folder_.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["refused"].size(), 1u);
  EXPECT_EQ(json["refused"][0]["error"], 3101);
  EXPECT_EQ(json["effects"].size(), 2u);
  const Outcome used =
      render({"--plugin-path", folder_.path(), "--effects", "broken", "--write", "color=c.png"});
  expectError(used, 3201, "broken.so");
}

TEST_F(CommandLine, BackendsListsDevices) {
  const Outcome outcome = grisaille({"backends", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json.size(), 2u);
  size_t devices = 0;
  for (const auto& backend : json) devices += backend["devices"].size();
  EXPECT_GE(devices, 1u);
  EXPECT_NE(grisaille({"backends"}).out.find("opengl"), std::string::npos);
}

TEST_F(CommandLine, MistakesNameTheNearestValidThing) {
  expectError(render({"--effects", "sao"}), 3201, "ssao");
  expectError(render({"--effects", "ssao,ssao"}), 3204);
  expectError(render({"--set", "ssao.radus=1"}), 3301, "radius");
  expectError(render({"--set", "ssao.kernel_size=5000"}), 3302, "4096");
  expectError(render({"--set", "ssao.kernel_size=many"}), 3303);
  expectError(render({"--set", "ssao.blur=boxx"}), 3302, "box");
  expectError(render({"--set", "ssao.radius=nan"}), 3303);
  expectError(render({"--set", "radius"}), 5101);
  expectError(render({"--write", "colour=c.png"}), 5102, "color");
  expectError(render({"--write", "color=c.jpg"}), 4102);
  expectError(render({"--write", "color"}), 5101);
  expectError(render({"--write", "color=missing/c.png"}), 4103);
  expectError(render({"--size", "16"}), 5101);
  expectError(render({"--size", "0x9"}), 5101);
  expectError(render({"--size", "99999x9"}), 5101);
  expectError(render({"--backend", "metal"}), 1002, "opengl");
  expectError(render({"--device", "no such device"}), 1003);
  expectError(render({"--frames", "0"}), 5101);
  expectError(render({"--bakend", "opengl"}), 5101);
  expectError(render({"--config", "missing.toml"}), 5103);
  expectError(render({"--plugin-path", "missing"}), 3106);
  expectError(grisaille({}), 5101);
  EXPECT_TRUE(folder_.files().empty()) << folder_.files()[0];
}

TEST_F(CommandLine, SettingsFileIsTakenAndTheCommandLineGoesOverIt) {
  const std::string good = folder_.write(
      "good.toml", "effects = [\"ssao\"]\n[ssao]\nintensity = 0\nblur = \"edge_aware\"\n");
  EXPECT_EQ(render({"--config", good, "--write", "ao=0.exr"}).status, 0);
  EXPECT_EQ(render({"--config", good, "--set", "ssao.intensity=1", "--write", "ao=1.exr"}).status,
            0);
  EXPECT_NE(readFile(folder_ / "0.exr"), readFile(folder_ / "1.exr"));

  expectError(render({"--config", folder_.write("a.toml", "[ssao]\nradius = \n")}), 5103,
              "a.toml:2");
  expectError(render({"--config", folder_.write("b.toml", "\n[ssao]\nradus = 1\n")}), 3301,
              "b.toml:3");
  expectError(render({"--config", folder_.write("c.toml", "[ssao]\nradius = -1\n")}), 3302,
              "c.toml:2");
  expectError(render({"--config", folder_.write("d.toml", "effects = 3\n")}), 5104, "d.toml:1");
  expectError(render({"--config", folder_.write("e.toml", "[ssao]\nradius = [1]\n")}), 5104);
  expectError(render({"--config", folder_.write("f.toml", "[sspn]\nradius = 1\n")}), 3201,
              "f.toml:2");
  expectError(render({"--config", folder_.path()}), 5103);
}

TEST_F(CommandLine, TimingsAreCsvOfEveryPassOfEveryFrame) {
  const Outcome outcome = render({"--frames", "3", "--timings", "-", "--write", "ao=a.exr"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("frame,effect,pass,milliseconds,clock\n", 0), 0u) << outcome.out;
  for (const char* row : {"\n0,scene,guarded geometry,", "\n1,scene,guarded view_depth,",
                          "\n2,ssao,occlusion,", "\n2,ssao,upsample,"}) {
    EXPECT_NE(outcome.out.find(row), std::string::npos) << row << outcome.out;
  }
  EXPECT_TRUE(outcome.out.find(",wall\n") != std::string::npos ||
              outcome.out.find(",gpu\n") != std::string::npos);
  EXPECT_EQ(render({"--timings", "t.csv"}).status, 0);
  EXPECT_EQ(readFile(folder_ / "t.csv").rfind("frame,effect,pass,milliseconds,clock\n", 0), 0u);
}

TEST_F(CommandLine, CompletionIsAScriptThatCompletes) {
  const Outcome outcome = runShell(
      "source <(grisaille completion); COMP_WORDS=(grisaille render --set ssao.ker); COMP_CWORD=3; "
      "_grisaille 2>/dev/null; echo \"${COMPREPLY[@]}\"; "
      "COMP_WORDS=(grisaille re); COMP_CWORD=1; _grisaille; echo \"${COMPREPLY[@]}\"; "
      "COMP_WORDS=(grisaille render --tim); COMP_CWORD=2; _grisaille; echo \"${COMPREPLY[@]}\"; "
      "COMP_WORDS=(grisaille render --preset sspm); COMP_CWORD=3; _grisaille 2>/dev/null; "
      "echo \"${COMPREPLY[@]}\"; "
      "for word in = fa; do COMP_WORDS=(grisaille render --preset ssao = $word); COMP_CWORD=5; "
      "[[ $word == = ]] && unset 'COMP_WORDS[5]' && COMP_CWORD=4; "
      "_grisaille; echo \"${COMPREPLY[@]}\"; done; "
      "for option in --add --save; do COMP_WORDS=(grisaille render $option s); COMP_CWORD=3; "
      "_grisaille 2>/dev/null; echo \"${COMPREPLY[@]}\"; done; "
      "COMP_WORDS=(grisaille render --write pain); COMP_CWORD=3; _grisaille 2>/dev/null; "
      "echo \"${COMPREPLY[@]}\"",
      folder_.path());
  EXPECT_EQ(outcome.out,
            "ssao.kernel_size=\nrender\n--time --times --timings\n"
            "sspm=fast sspm=balanced sspm=fine sspm=reference\n"
            "fast balanced fine reference classic\nfast\n"
            "sspm=\nsspm=\npaint= paint_coverage= paint_owner=\n")
      << outcome.err;
}

TEST_F(CommandLine, SceneIsWrittenAndReadBack) {
  const Outcome outcome = grisaille({"scene", "--write", "a.glb", "--write-camera", "c.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_EQ(render({"a.glb", "--camera", "c.json", "--write", "depth=file.exr"}).status, 0);
  ASSERT_EQ(render({"--write", "depth=built_in.exr"}).status, 0);
  EXPECT_EQ(readFile(folder_ / "file.exr"), readFile(folder_ / "built_in.exr"));
}

TEST_F(CommandLine, ABuiltInSceneStandsForAFile) {
  const Outcome outcome = grisaille({"scene", "carving"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("carving: ")) << outcome.out;
  for (const char* command : {"render", "truth", "tune", "measure", "scene", "view"}) {
    const std::string help = grisaille({command, "--help"}).out;
    for (const char* name : {"atrium", "leaves", "grating", "street", "table", "carving"}) {
      EXPECT_NE(help.find(name), std::string::npos) << command;
    }
  }
  expectError(grisaille({"scene", "carvings"}), 2101, "nearest is carving");
}

// On a machine without one backend's driver library, the other backend still runs.
TEST_F(CommandLine, MissingLibraryOfOneBackendLeavesTheOther) {
  const auto without = [&](const std::string& library, const std::vector<std::string>& arguments) {
    return runProgram(arguments, folder_.path(),
                      {"LD_PRELOAD=" HIDE_LIBRARY, "HIDE_LIBRARY=" + library});
  };
  const auto runs = [&](const std::string& backend) {
    return render({"--backend", backend, "--write", "ao=a.png"}).status == 0;
  };
  if (!runs("opengl") || !runs("vulkan")) GTEST_SKIP() << "only one backend is present";
  for (const auto& [library, backend, other] :
       {std::array{"libEGL.so", "opengl", "vulkan"}, {"libvulkan.so", "vulkan", "opengl"}}) {
    expectError(without(library, {"render", "--size", "8x8", "--backend", backend}), 1001);
    const Outcome rest =
        without(library, {"render", "--size", "8x8", "--backend", other, "--write", "ao=a.png"});
    EXPECT_EQ(rest.status, 0) << rest.err;
    const Outcome any = without(library, {"render", "--size", "8x8", "--write", "ao=a.png"});
    EXPECT_EQ(any.status, 0) << any.err;
    EXPECT_EQ(any.out.rfind(other, 0), 0u) << any.out;
    EXPECT_NE(without(library, {"backends"}).out.find("E1001"), std::string::npos);
  }
}

// The program loads the slow picture codecs only for commands that read or write picture files.
// Tracing and drawing the built-in scene work without them.
TEST_F(CommandLine, OnlyReadingPicturesNeedsItsLibrary) {
  const std::vector<std::string> without = {"LD_PRELOAD=" HIDE_LIBRARY, "HIDE_LIBRARY=codecs"};
  const auto run = [&](const std::vector<std::string>& arguments) {
    return runProgram(arguments, folder_.path(), without);
  };
  EXPECT_EQ(run({"effects"}).status, 0);
  EXPECT_EQ(run({"backends"}).status, 0);
  EXPECT_EQ(run({"render", "--help"}).status, 0);
  const Outcome tuned = run({"tune", "--max-error", "1", "--evaluations", "1", "--random", "0",
                             "--size", "16x16", "--samples", "16", "--out", "t.toml"});
  EXPECT_EQ(tuned.status, 0) << tuned.err;
  const Outcome drawn = run({"render", "--size", "8x8", "--write", "depth=d.exr"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  expectError(run({"apply", "--depth", "d.exr", "--write", "color=c.png"}), 4105);
}

}  // namespace
}  // namespace grisaille::tests
