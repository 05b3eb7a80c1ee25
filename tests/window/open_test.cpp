// SPDX-License-Identifier: MIT
// Opening files: the dialog, scenes opened last, what cannot be opened, and loading that is
// cancelled.
#include <filesystem>
#include <sstream>

#include "tests/support/animated_gltf.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class OpenTest : public WindowTest {
 protected:
  // Room for the dialog beside the panel.
  std::vector<std::string> wide(const std::string& scene) const {
    return {scene,  "--backend", GetParam(),          "--size", "1280x720", "--effects",
            "ssao", "--set",     "ssao.kernel_size=2"};
  }
  // Lengths that the scene chose are told.
  static void quits(DrivenViewer& viewer) {
    const Outcome outcome = viewer.quit();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_TRUE(line.starts_with("note: ")) << line;
    }
  }
  static void untilScene(DrivenViewer& viewer, const std::string& camera) {
    viewer.untilChanged("camera", camera);
    viewer.send("mousemove 5 5");
    viewer.untilDrawn();
  }
};
GRISAILLE_IN_WINDOWS(OpenTest);

TEST_P(OpenTest, TheDialogCompletesAPathAndListsFolders) {
  fs::create_directory(folder_ / "models");
  folder_.write("models/moves.glb", animatedGlb());
  folder_.write("notes.txt", "");
  DrivenViewer viewer(folder_, wide("carving"));
  const std::string camera = viewer.value("camera");
  viewer.key("ctrl+o");
  viewer.untilThere("open path");
  EXPECT_EQ(viewer.value("open folder"), folder_.path().string());
  EXPECT_EQ(viewer.layout().contains("open file notes.txt"), false);
  viewer.type("mo");
  viewer.key("Tab");
  viewer.untilValue("open path", "models/");
  viewer.key("Tab");
  viewer.untilValue("open path", "models/moves.glb");
  viewer.key("Return");
  untilScene(viewer, camera);
  EXPECT_EQ(viewer.layout().contains("open path"), false);
  EXPECT_NE(viewer.value("time"), "");

  // By the pointer; the scene is in the list with its picture.
  viewer.key("Escape ctrl+o");
  viewer.untilThere("open file models");
  EXPECT_EQ(viewer.value("open recent " + (folder_ / "models/moves.glb")), "thumbnail");
  viewer.click("open file models");
  viewer.untilThere("open file moves.glb");
  EXPECT_EQ(viewer.value("open folder"), folder_ / "models");
  viewer.click("open file moves.glb");
  viewer.untilValue("open path", "moves.glb");
  viewer.click("open cancel");
  viewer.until("a closed dialog",
               [](const nlohmann::json& now) { return !now.contains("open path"); });
  viewer.key("Escape ctrl+o");
  viewer.untilThere("open path");
  viewer.key("Escape Escape");
  viewer.until("a closed dialog",
               [](const nlohmann::json& now) { return !now.contains("open path"); });
  quits(viewer);
}

TEST_P(OpenTest, AMissingSceneSaysWhatAndWhyAndWhatElseThereIs) {
  const std::string scene = folder_.write("moves.glb", animatedGlb());
  {
    DrivenViewer viewer(folder_, wide(scene));
    quits(viewer);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "state/grisaille/thumbnails"), {}), 1);
  DrivenViewer viewer(folder_, wide("missing.glb"));
  viewer.untilThere("failure");
  EXPECT_NE(viewer.value("failure").find("missing.glb"), std::string::npos);
  EXPECT_NE(viewer.value("failure").find("No such file"), std::string::npos)
      << viewer.value("failure");
  EXPECT_EQ(viewer.value("failure recent " + scene), "thumbnail");
  viewer.click("failure recent " + scene);
  viewer.until("a scene", [](const nlohmann::json& now) {
    return !now.contains("failure") && now["picture"]["value"] == "done";
  });
  EXPECT_NE(viewer.value("time"), "");
  quits(viewer);
}

TEST_P(OpenTest, AFolderWithoutPermissionAndABrokenSceneAreNoCrash) {
  folder_.write("broken.glb", "glTF");
  DrivenViewer viewer(folder_, wide("carving"));
  const std::string camera = viewer.value("camera");
  viewer.key("ctrl+o");
  viewer.untilThere("open path");
  viewer.type("broken.glb");
  viewer.key("Return");
  viewer.untilThere("failure");
  EXPECT_EQ(viewer.value("camera"), camera);
  viewer.click("failure close");
  viewer.until("the picture", [](const nlohmann::json& now) { return !now.contains("failure"); });
  viewer.key("Escape ctrl+o");
  viewer.untilThere("open path");
  viewer.type("/proc/1/fdinfo/no/");
  viewer.key("Return");
  viewer.until("a message", [](const nlohmann::json& now) {
    return now.contains("error") || now.contains("open error");
  });
  viewer.key("Escape Escape Left");
  viewer.untilChanged("camera", camera);
  quits(viewer);
}

// The atrium, made by the program, and a large scene: the first is given up for the second.
TEST_P(OpenTest, LoadingIsShownAndCancelled) {
  if (sponza().empty()) GTEST_SKIP() << "no Sponza";
  DrivenViewer viewer(folder_, wide("carving"));
  const std::string camera = viewer.value("camera");
  viewer.key("ctrl+o");
  viewer.untilThere("open path");
  viewer.type(sponza());
  viewer.key("Return");
  viewer.until("a bar", [](const nlohmann::json& now) { return now.contains("cancel loading"); });
  viewer.click(viewer.middle("cancel loading"));
  viewer.until("no bar", [](const nlohmann::json& now) { return !now.contains("cancel loading"); });
  viewer.untilDrawn();
  EXPECT_EQ(viewer.value("camera"), camera);
  EXPECT_NE(viewer.value("message").find("cancelled"), std::string::npos)
      << viewer.value("message");
  quits(viewer);
}

TEST_P(OpenTest, TheFirstStartSaysHowToBegin) {
  {
    DrivenViewer viewer(folder_, wide("carving"));
    EXPECT_NE(viewer.value("message").find("F1"), std::string::npos) << viewer.value("message");
    quits(viewer);
  }
  DrivenViewer viewer(folder_, wide("carving"));
  EXPECT_EQ(viewer.value("message").find("F1"), std::string::npos) << viewer.value("message");
  quits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
