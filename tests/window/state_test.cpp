// SPDX-License-Identifier: MIT
// The panel says what is so: at the start, after a change elsewhere, and after a failure that is
// over.
#include <filesystem>
#include <set>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class StateTest : public WindowTest {
 protected:
  // Replaces a plugin as a build does: a library that is loaded must not be written to.
  void replacePlugin(const std::string& name, const fs::path& from) {
    const fs::path part = folder_ / (name + ".part");
    fs::copy_file(from, part);
    fs::rename(part, folder_ / name);
  }
  std::vector<uint32_t> pixelsOf(const DrivenViewer& viewer) {
    const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<uint32_t>>();
    return display_.pixels(rect[0], rect[1], rect[2] - rect[0], rect[3] - rect[1]);
  }
};
GRISAILLE_IN_WINDOWS(StateTest);

TEST_P(StateTest, AtTheStartThereIsNothingToUndo) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao,sspm", "--set", "ssao.radius=0.25"}));
  viewer.key("ctrl+z");
  viewer.untilDrawn();
  EXPECT_EQ(viewer.value("ssao.on"), "true");
  EXPECT_EQ(viewer.value("sspm.on"), "true");
  EXPECT_EQ(viewer.value("ssao.radius"), "0.25");
  expectQuits(viewer);
}

TEST_P(StateTest, ASplitComparisonShowsTheTruth) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao"}),
                      {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  viewer.key("t");
  viewer.until("a comparison",
               [](const nlohmann::json& now) { return now["compare"]["value"] == "true"; });
  viewer.key("x");
  viewer.until("the truth on the right", [](const nlohmann::json& now) {
    return now.contains("view right") && now["view right"]["value"] == "truth";
  });
  EXPECT_EQ(viewer.value("view"), "error");
  expectQuits(viewer);
}

// Nobody has measured the preset's error and cost at another radius.
TEST_P(StateTest, APresetIsLitOnlyWhileItIsInUse) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", kWindow, "--effects", "ssao",
                                "--preset", "ssao=fast"});
  EXPECT_EQ(viewer.value("ssao.preset.fast"), "true");
  viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.7, 0.5));
  viewer.untilValue("ssao.presets", "custom");
  EXPECT_EQ(viewer.value("ssao.preset.fast"), "false");
  viewer.key("ctrl+z");
  viewer.untilValue("ssao.presets", "fast");
  expectQuits(viewer);
}

// Two controls with one ImGui id: a click on one does nothing, or works the other.
TEST_P(StateTest, EveryControlHasAnIdOfItsOwn) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "500x3600", "--effects",
                                "ssao,sspm", "--set", "ssao.kernel_size=2"});
  for (const std::string section : {"Settings", "Cost", "Camera", "Scene"}) {
    viewer.click("section " + section);
    viewer.untilValue("section " + section, "open");
  }
  viewer.key("Escape space");
  viewer.untilValue("sspm.objects", "1");
  for (const std::string tree : {"ssao.advanced", "sspm.advanced", "ssao.tune", "sspm.list"}) {
    if (viewer.value(tree) != "closed") continue;
    viewer.click(viewer.at(tree, 0.3, 0.5));
    viewer.untilValue(tree, "open");
  }
  std::map<unsigned, std::string> owners;
  const nlohmann::json all = viewer.layout();
  for (const auto& [name, control] : all.items()) {
    const unsigned id = control.value("id", 0u);
    if (id == 0) continue;
    const auto [owner, fresh] = owners.emplace(id, name);
    EXPECT_TRUE(fresh) << name << " has the id of " << owner->second;
  }
  EXPECT_GT(owners.size(), 40u);
  expectQuits(viewer);
}

TEST_P(StateTest, SettingsAreSavedAndLoadedBesideObjects) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "500x2600", "--effects",
                                "ssao,sspm", "--set", "ssao.kernel_size=6"});
  viewer.click("section Settings");
  viewer.untilThere("save settings");
  ASSERT_EQ(viewer.value("section Objects"), "open");
  const auto says = [&](const std::string& start) {
    viewer.until(start, [&](const nlohmann::json& now) {
      return now.contains("message") &&
             now["message"]["value"].get<std::string>().starts_with(start);
    });
    viewer.untilDrawn();
  };
  viewer.click("save settings");
  says("settings to settings.toml");
  EXPECT_TRUE(fs::exists(folder_ / "settings.toml"));
  viewer.click("sspm.save");
  says("0 shots to sspm.json");
  viewer.drag(viewer.at("ssao.intensity", 0.5, 0.5), viewer.at("ssao.intensity", 0.9, 0.5));
  viewer.untilChanged("ssao.intensity", "1");
  viewer.click("load settings");
  says("settings from settings.toml");
  EXPECT_EQ(viewer.value("ssao.intensity"), "1");
  viewer.click("sspm.load");
  says("0 shots from sspm.json");
  expectQuits(viewer);
}

// One evaluation: that of the setting that is there, which is accurate enough. No preset has these
// values.
TEST_P(StateTest, ASearchStartsFromTheSettingThatIsThere) {
  DrivenViewer viewer(
      folder_,
      {"--backend", GetParam(), "--size", "440x1680", "--effects", "ssao", "--preset", "ssao=fast",
       "--set", "ssao.kernel_size=3", "--truth-rays", "16", "--compare-truth"},
      {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  viewer.click(viewer.at("ssao.tune", 0.3, 0.5));
  viewer.untilThere("ssao.tune.start");
  for (const auto& [control, text] :
       {std::pair{"ssao.tune.error", "0.9"}, {"ssao.tune.evaluations", "1"}}) {
    viewer.click(viewer.at(control, 0.2, 0.5));
    viewer.untilDrawn();
    viewer.key("ctrl+a");
    viewer.type(text);
    viewer.key("Return");
    viewer.untilValue(control, text);
  }
  viewer.click("ssao.tune.start");
  viewer.untilThere("ssao.tune.cancel");
  viewer.untilThere("ssao.tune.result");
  EXPECT_TRUE(viewer.value("ssao.tune.result").starts_with("RMSE "))
      << viewer.value("ssao.tune.result");
  EXPECT_EQ(viewer.value("ssao.kernel_size"), "3");
  EXPECT_EQ(viewer.value("ssao.presets"), "custom");
  expectQuits(viewer);
}

// The last picture stays while frames fail, and a frame is drawn by itself once it can be.
TEST_P(StateTest, AFailedFrameIsTriedAgain) {
  DrivenViewer viewer(folder_,
                      {"--backend", GetParam(), "--size", kWindow, "--effects", "moody",
                       "--plugin-path", MOODY, "--view", "moody.all"},
                      {"MOODY=" + (folder_ / "mood")});
  const std::vector<uint32_t> before = pixelsOf(viewer);
  EXPECT_EQ(before[before.size() / 2] & 0xffffffu, 0xffffffu);
  folder_.write("mood", "bad");
  viewer.key("Left");
  viewer.until("an error", [](const nlohmann::json& now) { return now.contains("error"); });
  EXPECT_NE(viewer.value("error").find("moody"), std::string::npos) << viewer.value("error");
  EXPECT_EQ(viewer.value("picture"), "failed");
  EXPECT_EQ(pixelsOf(viewer), before);
  fs::remove(folder_ / "mood");
  viewer.until("no error", [](const nlohmann::json& now) { return !now.contains("error"); });
  viewer.untilDrawn();
  EXPECT_EQ(pixelsOf(viewer), before);
  EXPECT_EQ(viewer.value("picture"), "done");
  expectQuits(viewer);
}

TEST_P(StateTest, AMendedPluginComesBackAsItWas) {
  fs::create_directory(folder_ / "more");
  fs::copy_file(PLUGINS "/now/tables.so", folder_ / "more/tables.so");
  folder_.write("broken.so", "no library");
  DrivenViewer viewer(folder_, arguments({"--plugin-path", folder_ / "more", "--effects",
                                          "alpha,ssao", "--set", "alpha.count=7"}));
  EXPECT_EQ(viewer.value("alpha.on"), "true");
  replacePlugin("more/tables.so", folder_ / "broken.so");
  viewer.key("F5");
  viewer.untilThere("refused");
  EXPECT_EQ(viewer.value("alpha.on"), "");
  EXPECT_EQ(viewer.value("ssao.on"), "true");
  replacePlugin("more/tables.so", PLUGINS "/now/tables.so");
  viewer.key("F5");
  viewer.untilThere("alpha.on");
  EXPECT_EQ(viewer.value("alpha.on"), "true");
  EXPECT_EQ(viewer.value("alpha.count"), "7");
  EXPECT_EQ(viewer.value("refused"), "");
  EXPECT_EQ(viewer.value("error"), "");
  // The reload is no step of undo, and alpha runs first, as before.
  viewer.key("ctrl+z");
  viewer.untilDrawn();
  EXPECT_EQ(viewer.value("alpha.on"), "true");
  EXPECT_LT(viewer.middle("alpha.on").y, viewer.middle("ssao.on").y);
  expectQuits(viewer);
}

TEST_P(StateTest, AnErrorGoesOnceTheSameThingSucceeds) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "500x2600", "--effects", "ssao",
                                "--set", "ssao.kernel_size=6"});
  viewer.click("section Settings");
  viewer.untilThere("load settings");
  viewer.click("load settings");
  viewer.untilThere("error");
  EXPECT_NE(viewer.value("error").find("settings.toml"), std::string::npos);
  viewer.click("save settings");  // another thing
  viewer.until("settings", [](const nlohmann::json& now) {
    return now["message"]["value"].get<std::string>().starts_with("settings to");
  });
  EXPECT_NE(viewer.value("error"), "");
  viewer.click("load settings");
  viewer.until("no error", [](const nlohmann::json& now) { return !now.contains("error"); });
  EXPECT_TRUE(viewer.value("message").starts_with("settings from")) << viewer.value("message");
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
