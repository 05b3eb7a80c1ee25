// SPDX-License-Identifier: MIT
// Opening files: the dialog, scenes opened last, what cannot be opened, and loading that is
// cancelled.
#include <filesystem>
#include <optional>
#include <thread>

#include "app/process/child.h"
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
  expectQuits(viewer);
}

TEST_P(OpenTest, AMissingSceneSaysWhatAndWhyAndWhatElseThereIs) {
  const std::string scene = folder_.write("moves.glb", animatedGlb());
  {
    DrivenViewer viewer(folder_, wide(scene));
    expectQuits(viewer);
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
  expectQuits(viewer);
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
  expectQuits(viewer);
}

TEST_P(OpenTest, LoadingIsCancelled) {
  if (sponza().empty()) GTEST_SKIP() << "no Sponza";
  for (int i = 0; i < 5; ++i) {
    DrivenViewer viewer(folder_, wide("carving"));
    const std::string camera = viewer.value("camera");
    viewer.key("ctrl+o");
    viewer.untilThere("open path");
    viewer.type(sponza());
    viewer.key("Return Escape");  // Esc comes a frame after the loading has begun
    bool cancelled = false;
    viewer.until("a loading that has ended", [&](const nlohmann::json& now) {
      cancelled = now.contains("message") &&
                  now["message"]["value"].get<std::string>().find("cancelled") != std::string::npos;
      return cancelled || now["camera"]["value"] != camera;
    });
    if (!cancelled) continue;  // a fast machine may have loaded it by then
    viewer.untilDrawn();
    EXPECT_EQ(viewer.value("camera"), camera);
    EXPECT_FALSE(viewer.layout().contains("cancel loading"));
    // Another scene can be opened at once.
    viewer.key("Escape ctrl+o");
    viewer.untilThere("open path");
    viewer.type(sponza());
    viewer.key("Return");
    untilScene(viewer, camera);
    expectQuits(viewer);
    return;
  }
  FAIL() << "Esc never came while it loaded";
}

// A session bus of its own, with a portal that answers with one file.
class Bus {
 public:
  explicit Bus(const std::string& uri)
      : daemon_({"dbus-daemon", "--session", "--nofork", "--print-address"}) {
    address_ = firstLine(daemon_);
    if (address_.empty()) return;
    portal_.emplace(
        std::vector<std::string>{"env", "DBUS_SESSION_BUS_ADDRESS=" + address_, FAKE_PORTAL, uri});
    if (firstLine(*portal_) != "ready") address_.clear();
  }
  const std::string& address() const { return address_; }  // "": there is no bus

 private:
  static std::string firstLine(app::Child& child) {
    for (int i = 0; i < 500; ++i) {
      const bool runs = child.running();
      const size_t end = child.out().find('\n');
      if (end != std::string::npos) return child.out().substr(0, end);
      if (!runs) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return "";
  }

  app::Child daemon_;
  std::optional<app::Child> portal_;
  std::string address_;
};

TEST_P(OpenTest, TheDesktopsDialogIsUsedWhereThereIsOne) {
  const std::string scene = folder_.write("it moves.glb", animatedGlb());
  for (const std::string& uri : {"file://" + (folder_ / "it%20moves.glb"), std::string()}) {
    const Bus bus(uri);
    if (bus.address().empty()) GTEST_SKIP() << "no dbus-daemon or no libsystemd";
    DrivenViewer viewer(folder_, wide("carving"), {"DBUS_SESSION_BUS_ADDRESS=" + bus.address()});
    const std::string camera = viewer.value("camera");
    viewer.key("ctrl+o");
    if (!uri.empty()) {
      untilScene(viewer, camera);
      EXPECT_NE(viewer.value("time"), "");
    } else {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      EXPECT_EQ(viewer.value("camera"), camera);
    }
    EXPECT_EQ(viewer.layout().contains("open path"), false);
    expectQuits(viewer);
  }
}

TEST_P(OpenTest, TheFirstStartSaysHowToBegin) {
  {
    DrivenViewer viewer(folder_, wide("carving"));
    EXPECT_NE(viewer.value("message").find("F1"), std::string::npos) << viewer.value("message");
    expectQuits(viewer);
  }
  DrivenViewer viewer(folder_, wide("carving"));
  EXPECT_EQ(viewer.value("message").find("F1"), std::string::npos) << viewer.value("message");
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
