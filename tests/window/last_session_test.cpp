// SPDX-License-Identifier: MIT
// Sessions: what the user has set comes back at the next start, or from a file.
#include <filesystem>

#include "tests/support/animated_gltf.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class LastSessionTest : public WindowTest {
 protected:
  // Starts without a word about effects, values or scene.
  std::vector<std::string> bare(std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"--backend", GetParam(), "--size", kWindow};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static nlohmann::json kept(const DrivenViewer& viewer) {
    return valuesOf(viewer, {"camera", "ssao.on", "sspm.on", "ssao.kernel_size", "ssao.intensity",
                             "ssao.radius", "sspm.objects", "view", "split", "view right", "base",
                             "section View"});
  }
  // Sets something of each kind. Returns it as kept() does.
  static nlohmann::json changeAll(DrivenViewer& viewer) {
    change(viewer);
    viewer.click("base");
    viewer.untilValue("base", "true");
    viewer.key("Escape x v");
    viewer.untilValue("split", "true");
    rest(viewer);
    return kept(viewer);
  }
};
GRISAILLE_IN_WINDOWS(LastSessionTest);

TEST_P(LastSessionTest, EverythingComesBackUnlessTheCommandLineSaysOtherwise) {
  nlohmann::json before;
  {
    DrivenViewer viewer(folder_,
                        bare({"carving", "--effects", "ssao,sspm", "--set", "ssao.kernel_size=6"}));
    before = changeAll(viewer);
    expectQuits(viewer);
  }
  {
    DrivenViewer viewer(folder_, bare());
    EXPECT_EQ(kept(viewer), before);
    viewer.key("ctrl+z");  // what comes back is no step of undo
    viewer.untilDrawn();
    EXPECT_EQ(kept(viewer), before);
    expectQuits(viewer);
  }
  {
    // What is named wins, the rest comes back.
    DrivenViewer viewer(folder_, bare({"--set", "ssao.intensity=3", "--view", "depth"}));
    nlohmann::json wanted = before;
    wanted["ssao.intensity"] = "3";
    wanted["view"] = "depth";
    EXPECT_EQ(kept(viewer), wanted);
    expectQuits(viewer);
  }
  {
    // Camera and objects belong to their scene.
    DrivenViewer viewer(folder_, bare({"leaves", "--effects", "sspm"}));
    EXPECT_EQ(viewer.value("ssao.on"), "false");
    EXPECT_EQ(viewer.value("sspm.objects"), "0");
    EXPECT_NE(nlohmann::json(viewer.value("camera")), before["camera"]);
    expectQuits(viewer);
  }
  EXPECT_TRUE(fs::exists(folder_ / "state/grisaille/session-before.json"));
  DrivenViewer viewer(folder_, bare({"carving", "--fresh", "--set", "ssao.kernel_size=6"}));
  EXPECT_EQ(viewer.value("sspm.objects"), "");
  EXPECT_EQ(viewer.value("ssao.intensity"), "1");
  EXPECT_EQ(viewer.value("split"), "false");
  expectQuits(viewer);
}

TEST_P(LastSessionTest, AFileIsSavedAndOpened) {
  nlohmann::json before;
  {
    DrivenViewer viewer(folder_,
                        bare({"carving", "--effects", "ssao,sspm", "--set", "ssao.kernel_size=6"}));
    before = changeAll(viewer);
    // A path of two cameras.
    viewer.click("section View");
    viewer.untilValue("section View", "closed");
    viewer.click("section Effects");
    viewer.untilValue("section Effects", "closed");
    viewer.click("section Sequence");
    viewer.untilThere("path add");
    viewer.click("path add");
    viewer.untilValue("path bookmark", "1");
    viewer.key("Escape Right");
    viewer.untilChanged("camera", before["camera"]);
    viewer.click("path add");
    viewer.untilValue("path bookmark", "2");
    viewer.click("path.0");
    viewer.untilValue("camera", before["camera"]);
    fill(viewer, "sequence seconds", "2.5");
    fill(viewer, "sequence file", "tour.###.png");
    viewer.click("sequence filmed");
    viewer.untilValue("sequence filmed", "true");
    fill(viewer, "sequence video", "tour.webm");
    viewer.click("section Sequence");
    viewer.untilValue("section Sequence", "closed");
    viewer.click("section Effects");
    viewer.untilValue("section Effects", "open");
    viewer.click("section Settings");
    viewer.untilThere("save session");
    viewer.click("save session");
    viewer.until("a session", [](const nlohmann::json& now) {
      return now.contains("message") && now["message"]["value"] == "session to session.json";
    });
    // It is opened again after changes; these can be undone.
    viewer.click("ssao.on");
    viewer.untilValue("ssao.on", "false");
    viewer.key("Escape Left Left");
    viewer.click("open session");
    viewer.untilValue("ssao.on", "true");
    viewer.untilValue("camera", before["camera"]);
    EXPECT_EQ(viewer.value("sspm.objects"), "1");
    viewer.key("Escape ctrl+z");
    viewer.untilValue("ssao.on", "false");
    expectQuits(viewer);
  }
  // On another machine, from the command line.
  before["section View"] = "closed";
  fs::remove_all(folder_ / "state");
  DrivenViewer viewer(folder_, bare({"--session", "session.json"}));
  EXPECT_EQ(nlohmann::json(viewer.value("camera")), before["camera"]);
  EXPECT_EQ(nlohmann::json(viewer.value("ssao.intensity")), before["ssao.intensity"]);
  EXPECT_EQ(viewer.value("sspm.objects"), "1");
  EXPECT_EQ(viewer.value("section View"), "closed");
  // The path, its pictures and its video.
  viewer.click("section Effects");
  viewer.untilValue("section Effects", "closed");
  viewer.click("section Sequence");
  viewer.untilValue("path bookmark", "2");
  EXPECT_EQ(valuesOf(viewer, {"sequence seconds", "sequence file", "sequence video"}),
            nlohmann::json({{"sequence seconds", "2.5"},
                            {"sequence file", "tour.###.png"},
                            {"sequence video", "tour.webm"}}));
  viewer.click("path.1");
  viewer.untilChanged("camera", before["camera"]);
  viewer.click("path.0");
  viewer.untilValue("camera", before["camera"]);
  expectQuits(viewer);
  // It is the last session now. Another scene does not take the path over.
  DrivenViewer other(folder_, bare({"leaves"}));
  other.untilThere("path bookmark");
  EXPECT_EQ(other.value("path bookmark"), "0");
  EXPECT_EQ(other.value("sequence file"), "tour.###.png");
  expectQuits(other);
}

TEST_P(LastSessionTest, AnAnimationAndItsTimeComeBack) {
  const std::string scene = folder_.write("moves.glb", animatedGlb());
  std::string camera;
  {
    DrivenViewer viewer(folder_, bare({scene, "--effects", "ssao", "--set", "ssao.kernel_size=2",
                                       "--animation", "0", "--time", "0.25"}));
    EXPECT_EQ(viewer.value("time"), "0.25");
    camera = viewer.value("camera");
    expectQuits(viewer);
  }
  DrivenViewer viewer(folder_, bare());
  EXPECT_EQ(viewer.value("animation"), "0");
  EXPECT_EQ(viewer.value("time"), "0.25");
  EXPECT_EQ(viewer.value("camera"), camera);
  expectQuits(viewer);
}

TEST_P(LastSessionTest, ABrokenSessionIsKeptAndTold) {
  fs::create_directories(folder_ / "state/grisaille");
  folder_.write("state/grisaille/session.json", R"({"grisaille_session": 1, "effects": 3})");
  {
    DrivenViewer viewer(folder_, bare({"carving", "--set", "ssao.kernel_size=6"}));
    EXPECT_NE(viewer.value("error").find("E5109"), std::string::npos) << viewer.value("error");
    EXPECT_NE(viewer.value("error").find("effects"), std::string::npos) << viewer.value("error");
    expectQuits(viewer);
  }
  EXPECT_TRUE(fs::exists(folder_ / "state/grisaille/session.json.damaged"));
  const Outcome outcome = runProgram(
      {"view", "--backend", GetParam(), "--session", "state/grisaille/session.json.damaged"},
      folder_.path());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("E5109"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
