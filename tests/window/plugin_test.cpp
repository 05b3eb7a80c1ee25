// SPDX-License-Identifier: MIT
// Plugins that appear or change while the viewer runs.
#include <filesystem>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

using PluginTest = WindowTest;
GRISAILLE_IN_WINDOWS(PluginTest);

TEST_P(PluginTest, ARescanFindsWhatIsNew) {
  fs::create_directory(folder_ / "more");
  DrivenViewer viewer(folder_, arguments({"--plugin-path", folder_ / "more"}));
  EXPECT_EQ(viewer.value("alpha.on"), "");
  fs::copy_file(PLUGINS "/now/tables.so", folder_ / "more/tables.so");
  folder_.write("more/broken.so", "no library");
  viewer.key("F5");
  viewer.untilValue("alpha.on", "false");
  EXPECT_NE(viewer.value("refused").find("broken.so"), std::string::npos);
  // The earlier settings are still there.
  EXPECT_EQ(viewer.value("ssao.kernel_size"), "6");
  expectQuits(viewer);
}

// A minimal build folder: its target copies a plugin, or fails like a compiler.
TEST_P(PluginTest, AnEditedSourceIsBuiltAndLoaded) {
  fs::create_directory(folder_ / "more");
  fs::create_directory(folder_ / "source");
  const fs::path plugin = folder_ / "more/tables.so";
  fs::copy_file(PLUGINS "/now/tables.so", plugin);
  folder_.write("source/CMakeLists.txt",
                "cmake_minimum_required(VERSION 3.25)\nproject(P LANGUAGES NONE)\n"
                "add_custom_target(effect_tables COMMAND sh ${CMAKE_SOURCE_DIR}/make.sh)\n");
  const std::string good = "cp '" PLUGINS "/later/tables_later.so' '" + plugin.string() +
                           ".new' && mv '" + plugin.string() + ".new' '" + plugin.string() + "'\n";
  folder_.write("source/make.sh", good);
  folder_.write("source/a.comp", "first");
  ASSERT_EQ(runShell("cmake -S source -B built -G Ninja", folder_.path()).status, 0);
  folder_.write("more/tables.build.json", R"({"build": ")" + (folder_ / "built") +
                                              R"(", "target": "effect_tables", "watch": [")" +
                                              (folder_ / "source") + R"("]})");
  DrivenViewer viewer(folder_, arguments({"--plugin-path", folder_ / "more"}));
  viewer.click(viewer.at("alpha.tree", 0.3, 0.5));
  viewer.untilThere("alpha.hard");
  // The build fails: the old plugin stays, and the viewer shows the compiler's message.
  folder_.write("source/make.sh", "echo \"a.comp:3: error: 'depht' : undeclared\"; exit 1\n");
  viewer.untilThere("build message");
  EXPECT_EQ(viewer.value("build message"), "a.comp:3: error: 'depht' : undeclared");
  EXPECT_EQ(viewer.value("alpha.hard"), "false");
  // The build succeeds: the viewer loads the new plugin without a restart.
  folder_.write("source/make.sh", good);
  viewer.untilThere("alpha.soft");
  EXPECT_EQ(viewer.value("build message"), "");
  EXPECT_EQ(viewer.value("alpha.hard"), "");
  // The next edit makes a plugin that is refused, and the one after it mends that.
  folder_.write("source/make.sh", "echo none > '" + plugin.string() + ".new' && mv '" +
                                      plugin.string() + ".new' '" + plugin.string() + "'\n");
  viewer.untilThere("refused");
  EXPECT_EQ(viewer.value("alpha.soft"), "");
  folder_.write("source/make.sh", good);
  viewer.untilThere("alpha.on");
  EXPECT_EQ(viewer.value("refused"), "");
  expectQuits(viewer);
}

class LackTest : public WindowTest {};
GRISAILLE_IN_WINDOWS(LackTest);

// The picture is drawn without an effect that lacks an input; the panel says what is missing.
TEST_P(LackTest, AnEffectThatLacksAnInputIsOffWithTheReason) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", kWindow, "--effects",
                                "needy,moody", "--plugin-path", MOODY});
  viewer.untilThere("needy.lacks");
  EXPECT_NE(viewer.value("needy.lacks").find("moody.all"), std::string::npos)
      << viewer.value("needy.lacks");
  EXPECT_EQ(viewer.value("needy.on"), "true");
  EXPECT_EQ(viewer.value("error"), "");
  EXPECT_EQ(viewer.value("picture"), "done");
  // Its input comes too late; one place earlier it is there.
  viewer.click("moody.up");
  viewer.until("no lack", [](const nlohmann::json& now) { return !now.contains("needy.lacks"); });
  viewer.click("moody.on");
  viewer.untilThere("needy.lacks");
  // A picture of the effect itself fails with the number.
  const Outcome outcome =
      runProgram({"render", "--backend", GetParam(), "--size", "16x16", "--plugin-path", MOODY,
                  "--effects", "needy", "--write", "needy.all=a.exr"},
                 folder_.path());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("E3208"), std::string::npos) << outcome.err;
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
