// SPDX-License-Identifier: MIT
// Windows of any size, with any input, or idle; a missing backend or display.
#include <glm/glm.hpp>
#include <random>
#include <thread>

#include "tests/support/animated_gltf.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

using HardshipTest = WindowTest;
GRISAILLE_IN_WINDOWS(HardshipTest);

TEST_P(HardshipTest, EverySize) {
  DrivenViewer viewer(folder_, {"--backend", GetParam(), "--size", "900x1000", "--set",
                                "ssao.kernel_size=2", "--set", "ssao.blur_size=0"});
  const std::string before = viewer.savePicture();
  const auto resize = [&](int width, int height) {
    viewer.send("search --name Grisaille windowsize " + std::to_string(width) + " " +
                std::to_string(height));
  };
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {4096, 4096}, {37, 4000}, {900, 1000}}) {
    resize(size.x, size.y);
    viewer.until("a frame", [&](const nlohmann::json& now) {
      const auto rect = now["picture"]["rect"].get<std::vector<int>>();
      return rect[2] == size.x && rect[3] == size.y;
    });
    if (size.x > 500) viewer.untilDrawn();
  }
  expectSame(viewer.savePicture(), before);
  expectQuits(viewer);
}

// A small screen, which a window may fill; the picture has room for the axes.
class InputTest : public WindowTest {
 protected:
  InputTest() : WindowTest(kSide) {}

  static constexpr int kSide = 900, kInputs = 50;  // pixels; inputs a batch
  const std::string animated_ = folder_.write("moves.glb", animatedGlb());

  // One batch, as words for xdotool.
  static std::string inputs(std::mt19937& random) {
    const auto below = [&](int count) {
      return std::to_string(std::uniform_int_distribution<int>(0, count - 1)(random));
    };
    const std::string keys[] = {
        "a",          "b",          "d",         "e",       "i",        "n",         "p",
        "q",          "s",          "v",         "w",       "x",        "1",         "ctrl+1",
        "Home",       "Tab",        "space",     "Return",  "Escape",   "Up",        "Down",
        "Left",       "shift+x",    "ctrl+o",    "Right",   "F1",       "F2",        "F5",
        "F11",        "ctrl+z",     "ctrl+y",    "t",       "ctrl+c",   "ctrl+s",    "ctrl+plus",
        "ctrl+minus", "ctrl+0",     "BackSpace", "shift+v", "plus",     "minus",     "7",
        "period",     "Delete",     "f",         "shift+w", "alt+Left", "alt+Right", "Prior",
        "Next",       "shift+Left", "k",         "comma"};
    std::string words;
    for (int i = 0; i < kInputs; ++i) {
      const int kind = std::uniform_int_distribution<int>(0, 5)(random);
      if (kind < 2) {
        words += "mousemove " + below(kSide) + " " + below(kSide) + " ";
      } else if (kind == 2) {
        words += "click " + std::to_string(1 + std::stoi(below(7))) + " ";
      } else if (kind == 3) {
        words += (random() % 2 == 0 ? "mousedown " : "mouseup ") +
                 std::to_string(1 + std::stoi(below(3))) + " ";
      } else {
        words += "key " + keys[random() % std::size(keys)] + " ";
      }
    }
    return words;
  }
};
GRISAILLE_IN_WINDOWS(InputTest);

// A thousand inputs, on a small scene, a large one and one that moves. The second is Sponza, where
// it is there.
TEST_P(InputTest, AnyInput) {
  constexpr int kBatches = 7;  // for each scene
  const std::string large = sponza().empty() ? "street" : sponza();
  std::mt19937 random(GetParam() == "opengl" ? 1 : 2);
  for (const std::string& scene : {std::string("carving"), large, animated_}) {
    SCOPED_TRACE(scene);
    DrivenViewer viewer(folder_, {scene, "--backend", GetParam(), "--size", "900x600", "--effects",
                                  "ssao,sspm", "--set", "ssao.kernel_size=2"});
    for (int batch = 0; batch < kBatches; ++batch) viewer.send(inputs(random));
    viewer.send("mouseup 1 mouseup 2 mouseup 3 key Escape key Escape");
    const Outcome outcome = viewer.quit();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_P(HardshipTest, ABookmarkBringsTheCameraBack) {
  DrivenViewer viewer(folder_, arguments({"--bookmarks", folder_ / "marks"}));
  const std::string camera = viewer.value("camera");
  viewer.key("ctrl+3");
  viewer.until("a bookmark", [](const nlohmann::json& now) {
    return now.contains("message") && now["message"]["value"] == "bookmark 3 set";
  });
  viewer.drag(viewer.at("picture", 0.5, 0.5), viewer.at("picture", 0.7, 0.4));
  viewer.untilChanged("camera", camera);
  viewer.key("3");
  viewer.untilValue("camera", camera);
  // The bookmark is an ordinary camera file.
  const Outcome outcome = runProgram(
      {"render", "--size", "16x16", "--camera", folder_ / "marks/3.json"}, folder_.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  expectQuits(viewer);
}

// All events arrive before the next frame begins, as they do when frames are slow.
TEST_P(HardshipTest, WhatIsHeldCountsForWhatWasTurned) {
  DrivenViewer viewer(folder_, arguments());
  const std::string camera = viewer.value("camera");
  const Point at = viewer.at("picture", 0.5, 0.5);
  const std::string window = "$(xdotool search --name Grisaille getwindowpid)";
  viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) + " keydown ctrl");
  viewer.untilDrawn();
  ASSERT_EQ(std::system(("kill -STOP " + window).c_str()), 0);
  viewer.send("click --repeat 3 4 keyup ctrl");
  ASSERT_EQ(std::system(("kill -CONT " + window).c_str()), 0);
  viewer.untilChanged("zoom", "1");
  EXPECT_EQ(viewer.value("zoom"), "1.953125");
  EXPECT_EQ(viewer.value("camera"), camera);
  expectQuits(viewer);
}

TEST_P(HardshipTest, NothingIsDrawnWhileNothingChanges) {
  DrivenViewer viewer(folder_, arguments());
  std::string drawn;
  const auto draws = [&] {
    drawn = viewer.value("drawn");
    std::this_thread::sleep_for(std::chrono::seconds(2));
    return viewer.value("drawn") != drawn;
  };
  // On a busy machine the window's own events still arrive after the first pictures.
  bool still = false;
  for (int i = 0; i < 5 && !still; ++i) still = !draws();
  EXPECT_TRUE(still);
  viewer.send("mousemove_relative 3 3");
  viewer.untilChanged("drawn", drawn);
  expectQuits(viewer);
}

TEST_P(HardshipTest, ABackendThatIsMissingIsNamedOrReplaced) {
  const std::string library = GetParam() == "opengl" ? "libEGL.so" : "libvulkan.so";
  const std::vector<std::string> hidden = {"LD_PRELOAD=" HIDE_LIBRARY, "HIDE_LIBRARY=" + library};
  const Outcome refused = runProgram({"view", "--backend", GetParam()}, folder_.path(), hidden);
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find(GetParam() == "opengl" ? "5202" : "1001"), std::string::npos)
      << refused.err;
  DrivenViewer viewer(folder_, {"--size", "640x700", "--set", "ssao.kernel_size=4"}, hidden);
  if (GetParam() == "opengl") {
    EXPECT_NE(viewer.value("message").find("opengl:"), std::string::npos);
  }
  const Outcome outcome = viewer.quit();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

// Any other name is a file of the present folder.
TEST_P(HardshipTest, ABuiltInSceneOpensByItsName) {
  const Outcome outcome =
      runProgram({"view", "carving", "--backend", GetParam(), "--size", "640x700", "--effects",
                  "ssao", "--set", "ssao.kernel_size=4", "--frames", "2", "--capture", "x.png"},
                 folder_.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(image::read(folder_ / "x.png").width, 640u);
}

TEST_P(HardshipTest, ASceneThatIsNotThereEndsARunOfFrames) {
  const Outcome outcome = runProgram({"view", "missing.glb", "--backend", GetParam(), "--size",
                                      "640x700", "--frames", "2", "--capture", "x.png"},
                                     folder_.path());
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("missing.glb"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "x.png"));
}

// The viewer saves unsaved work to a folder, and its final messages give a command that shows it
// again.
class RescueTest : public WindowTest {
 protected:
  std::vector<std::string> with(const std::string& bookmarks) const {
    return arguments({"--effects", "ssao,sspm", "--bookmarks", bookmarks});
  }
  // Makes a bookmark, a setting and a shot, and waits until the viewer shows each.
  void change(DrivenViewer& viewer) {
    viewer.key("ctrl+4");
    viewer.until("a bookmark", [](const nlohmann::json& now) {
      return now.contains("message") && now["message"]["value"] == "bookmark 4 set";
    });
    viewer.drag(viewer.at("ssao.radius", 0.5, 0.5), viewer.at("ssao.radius", 0.7, 0.5));
    viewer.untilChanged("ssao.radius", "0.5");
    radius_ = viewer.value("ssao.radius");
    viewer.key("b");
    viewer.click(viewer.at("picture", 0.5, 0.5));
    viewer.untilValue("sspm.objects", "1");
  }
  void expectRescued(const std::string& err) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "marks/4.json"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "state/grisaille/viewer.json"));
    const std::string words = "continue with: grisaille view ";
    const size_t at = err.find(words);
    ASSERT_NE(at, std::string::npos) << err;
    const size_t from = at + words.size();
    // `grisaille render` takes the same options.
    const Outcome outcome =
        runShell("grisaille render --size 16x16 " + err.substr(from, err.find('\n', from) - from),
                 folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_ / "state/grisaille")) {
      if (entry.path().filename() != "settings.toml") continue;
      EXPECT_NE(readFile(entry.path()).find("radius = " + radius_), std::string::npos)
          << readFile(entry.path());
      EXPECT_TRUE(std::filesystem::exists(entry.path().parent_path() / "sspm.json"));
      return;
    }
    ADD_FAILURE() << "the viewer saved no settings";
  }

  std::string radius_;
};
GRISAILLE_IN_WINDOWS(RescueTest);

TEST_P(RescueTest, ALostDeviceLosesNothingElse) {
  DrivenViewer viewer(
      folder_, with(folder_ / "marks"),
      {"LD_PRELOAD=" FAULTS, "FAULT=device_lost", "FAULT_WHEN=" + (folder_ / "now")});
  change(viewer);
  folder_.write("now", "");
  viewer.send("mousemove_relative 3 3");
  const Outcome outcome = viewer.ended();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("error E1006: "), std::string::npos) << outcome.err;
  expectRescued(outcome.err);
}

// Independent of the backend.
using SignalTest = RescueTest;
INSTANTIATE_TEST_SUITE_P(Backends, SignalTest, testing::Values("opengl"));

TEST_P(SignalTest, ASignalLosesNothing) {
  DrivenViewer viewer(folder_, with(folder_ / "marks"));
  change(viewer);
  ASSERT_EQ(std::system("kill $(xdotool search --name Grisaille getwindowpid)"), 0);
  const Outcome outcome = viewer.ended();
  EXPECT_EQ(outcome.status, 130);
  expectRescued(outcome.err);
}

TEST(NoDisplay, IsNamed) {
  const TemporaryFolder folder;
  const Outcome outcome = runProgram({"view"}, folder.path(),
                                     {"DISPLAY=", "WAYLAND_DISPLAY=", "HOME=" + (folder / "h")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("5201"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
