// SPDX-License-Identifier: MIT
// Presets, and searches for settings in the background of the viewer.
#include <toml++/toml.h>
#include <filesystem>
#include <regex>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class TuneTest : public WindowTest {
 protected:
  // A narrow picture, which is quick to trace.
  std::vector<std::string> narrow(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"--backend", GetParam(), "--size", "440x1680"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  static std::map<std::string, std::string> values(const DrivenViewer& viewer) {
    std::map<std::string, std::string> all;
    for (const char* key : {"resolution", "slices", "kernel_size", "thickness", "radius",
                            "blur_size", "intensity", "power"}) {
      all[key] = viewer.value(std::string("ssao.") + key);
    }
    return all;
  }

  static void type(DrivenViewer& viewer, const std::string& control, const std::string& text) {
    const Point at = viewer.at(control, 0.2, 0.5);
    viewer.click(at);
    viewer.untilDrawn();
    viewer.key("ctrl+a");
    viewer.type("'" + text + "'");
    viewer.key("Return");
    viewer.untilValue(control, text);
  }
};
GRISAILLE_IN_WINDOWS(TuneTest);

TEST_P(TuneTest, APresetIsOneStep) {
  const toml::table file = toml::parse_file(EFFECTS_FOLDER "/ssao.presets.toml");
  DrivenViewer viewer(folder_, narrow({"--preset", "ssao=fine", "--set", "ssao.power=1.5"}));
  EXPECT_EQ(viewer.value("ssao.preset.fine"), "true");
  viewer.click(viewer.at("ssao.advanced", 0.2, 0.5));
  viewer.untilThere("ssao.slices");
  for (const std::string name : {"fast", "balanced", "reference"}) {
    const auto before = values(viewer);
    const std::string was = viewer.value("ssao.presets");
    viewer.click("ssao.preset." + name);
    viewer.untilValue("ssao.preset." + name, "true");
    EXPECT_EQ(viewer.value("ssao.presets"), name);
    EXPECT_EQ(viewer.value("ssao.preset." + was), "false");
    for (const auto& [key, value] : *file[name]["values"].as_table()) {
      const std::string shown = viewer.value("ssao." + std::string(key.str()));
      if (value.is_string()) {
        EXPECT_EQ(shown, value.value_or(""));
      } else if (value.is_boolean()) {
        EXPECT_EQ(shown, value.value_or(false) ? "true" : "false");
      } else {
        EXPECT_EQ(std::stod(shown), value.value_or(-1.0));
      }
    }
    EXPECT_EQ(viewer.value("ssao.power"), "1.5");  // no preset names it
    viewer.key("ctrl+z");
    viewer.untilValue("ssao.presets", was);
    EXPECT_EQ(values(viewer), before);
    viewer.key("ctrl+shift+z");
    viewer.untilValue("ssao.presets", name);
  }
  viewer.drag(viewer.at("ssao.kernel_size", 0.4, 0.5), viewer.at("ssao.kernel_size", 0.7, 0.5));
  viewer.untilValue("ssao.presets", "custom");
  for (const std::string name : {"fast", "balanced", "fine", "reference"}) {
    EXPECT_EQ(viewer.value("ssao.preset." + name), "false");
  }
  // Nor does anybody know the error and the cost of a preset at another radius.
  viewer.key("ctrl+z");
  viewer.untilValue("ssao.presets", "reference");
  viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.7, 0.5));
  viewer.untilValue("ssao.presets", "custom");
  expectQuits(viewer);
}

TEST_P(TuneTest, SettingsGoOverAPreset) {
  for (const auto& [preset, number] : {std::pair{"ssao=best", "E3311"}, {"ssao", "E5101"}}) {
    const Outcome outcome = runProgram({"view", "--preset", preset}, folder_.path());
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.err.find(number), std::string::npos) << outcome.err;
  }
  folder_.write("own.toml", "[ssao]\nintensity = 1.25\nkernel_size = 14\n");
  DrivenViewer viewer(folder_, narrow({"--preset", "ssao=reference", "--config", "own.toml",
                                       "--set", "ssao.kernel_size=18"}));
  EXPECT_EQ(viewer.value("ssao.presets"), "custom");
  EXPECT_EQ(viewer.value("ssao.kernel_size"), "18");
  EXPECT_EQ(viewer.value("ssao.intensity"), "1.25");
  EXPECT_EQ(viewer.value("ssao.resolution"), "full");  // from the preset
  expectQuits(viewer);
}

TEST_P(TuneTest, APresetFileThatCannotBeReadSaysWhy) {
  fs::create_directory(folder_ / "more");
  fs::copy_file(PLUGINS "/now/tables.so", folder_ / "more/tables.so");
  folder_.write("more/alpha.presets.toml", "[fast\n");
  DrivenViewer viewer(folder_, narrow({"--plugin-path", folder_ / "more"}));
  viewer.click(viewer.at("alpha.tree", 0.3, 0.5));
  viewer.untilThere("alpha.hard");
  EXPECT_NE(viewer.value("alpha.presets").find("E3312"), std::string::npos);
  viewer.click("alpha.hard");
  viewer.untilValue("alpha.hard", "true");
  EXPECT_EQ(viewer.value("ssao.presets"), "balanced");  // the defaults
  expectQuits(viewer);
}

TEST_P(TuneTest, WhatIsFoundIsOneStep) {
  DrivenViewer viewer(
      folder_,
      narrow({"--effects", "ssao", "--preset", "ssao=reference", "--compare-truth", "--truth-rays",
              "16"}),
      {"XDG_CACHE_HOME=" + (folder_ / "cache"), "TMPDIR=" + folder_.path().string()});
  const auto before = values(viewer);
  viewer.click(viewer.at("ssao.tune", 0.3, 0.5));
  viewer.untilThere("ssao.tune.start");
  EXPECT_EQ(viewer.value("ssao.tune.by error"), "true");
  const toml::table file = toml::parse_file(EFFECTS_FOLDER "/ssao.presets.toml");
  EXPECT_EQ(std::stod(viewer.value("ssao.tune.error")), file["balanced"]["error"].value_or(-1.0));
  type(viewer, "ssao.tune.error", "0.3");
  type(viewer, "ssao.tune.evaluations", "6");
  viewer.click("ssao.tune.start");
  viewer.untilThere("ssao.tune.cancel");
  viewer.untilThere("ssao.tune.result");
  const std::string result = viewer.value("ssao.tune.result");
  EXPECT_TRUE(std::regex_match(
      result, std::regex("RMSE 0\\.[0-9]+ at [0-9.]+ ms, [1-6] evaluations; on unseen cameras "
                         "0\\.[0-9]+")))
      << result;
  const auto after = values(viewer);
  EXPECT_NE(after, before);
  EXPECT_EQ(after.at("radius"), before.at("radius"));  // the truth depends on it
  viewer.key("ctrl+z");
  viewer.untilValue("ssao.presets", "reference");
  EXPECT_EQ(values(viewer), before);
  viewer.key("ctrl+shift+z");
  viewer.untilValue("ssao.kernel_size", after.at("kernel_size"));
  EXPECT_EQ(values(viewer), after);
  // A search without a result shows the child's last line and changes nothing.
  type(viewer, "ssao.tune.error", "0.0001");
  type(viewer, "ssao.tune.evaluations", "1");
  viewer.click("ssao.tune.start");
  viewer.until("error 5303", [](const nlohmann::json& now) {
    return now.contains("ssao.tune.result") &&
           now["ssao.tune.result"]["value"].get<std::string>().find("E5303") != std::string::npos;
  });
  EXPECT_EQ(values(viewer), after);
  expectQuits(viewer);
  for (const std::string& name : folder_.files()) EXPECT_FALSE(name.starts_with("grisaille-tune"));
}

TEST_P(TuneTest, ASearchEndsWithTheWindow) {
  DrivenViewer viewer(
      folder_, narrow({"--effects", "ssao"}),
      {"XDG_CACHE_HOME=" + (folder_ / "cache"), "TMPDIR=" + folder_.path().string()});
  viewer.click(viewer.at("ssao.tune", 0.3, 0.5));
  viewer.untilThere("ssao.tune.start");
  type(viewer, "ssao.tune.evaluations", "100000");
  viewer.click("ssao.tune.start");
  viewer.until("the truth's progress", [](const nlohmann::json& now) {
    return now.contains("ssao.tune.progress") &&
           now["ssao.tune.progress"]["value"].get<std::string>().starts_with(
               "tracing truth 1 of 1: ");
  });
  viewer.click("ssao.tune.cancel");
  viewer.untilValue("ssao.tune.result", "cancelled");
  viewer.click("ssao.tune.start");
  viewer.untilThere("ssao.tune.cancel");
  expectQuits(viewer);
  for (const std::string& name : folder_.files()) EXPECT_FALSE(name.starts_with("grisaille-tune"));
  // The arguments of the child name the test's folder; the brackets keep the search from finding
  // itself. `cat | grep -q` ignores processes that end while they are read; grep alone would return
  // an error status.
  const std::string search =
      "cat /proc/[0-9]*/cmdline 2>&- | grep -qa '" + folder_.path().string() + "/grisaille-[t]une'";
  EXPECT_EQ(runShell(search, folder_.path()).status, 1);
}

}  // namespace
}  // namespace grisaille::tests
