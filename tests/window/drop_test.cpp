// SPDX-License-Identifier: MIT
// Files that are dropped on the window, through the protocol that file managers speak.
#include "tests/support/animated_gltf.h"
#include "tests/support/drag_source.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class DropTest : public WindowTest {
 protected:
  void drop(const DrivenViewer& viewer, const std::vector<std::string>& names) const {
    std::vector<std::string> uris;
    for (const std::string& name : names) uris.push_back("file://" + (folder_ / name));
    const Point at = viewer.at("picture", 0.5, 0.5);
    dropUris(uris, at.x, at.y);
  }
};
GRISAILLE_IN_WINDOWS(DropTest);

TEST_P(DropTest, AFileOfEachKindIsOpened) {
  folder_.write("it moves.glb", animatedGlb());
  folder_.write("values.toml", "[ssao]\nintensity = 3\n");
  folder_.write("camera.json", R"({"eye": [0, 2, 6], "target": [0, 0.5, 0], "fovy_degrees": 35})");
  folder_.write("notes.txt", "no file of the viewer");
  DrivenViewer viewer(folder_, arguments({"carving", "--effects", "ssao"}));
  const std::string camera = viewer.value("camera");
  EXPECT_EQ(viewer.value("time"), "");
  drop(viewer, {"it%20moves.glb"});
  viewer.untilThere("time");
  viewer.untilChanged("camera", camera);
  // Several files at once.
  drop(viewer, {"values.toml", "camera.json"});
  viewer.untilValue("ssao.intensity", "3");
  viewer.until("the camera", [](const nlohmann::json& now) {
    return nlohmann::json::parse(now["camera"]["value"].get<std::string>())["fovy_degrees"] == 35;
  });
  EXPECT_EQ(viewer.value("error"), "");
  // What cannot be opened changes nothing.
  drop(viewer, {"notes.txt"});
  viewer.untilThere("error");
  EXPECT_NE(viewer.value("error").find("notes.txt"), std::string::npos) << viewer.value("error");
  EXPECT_EQ(viewer.value("ssao.intensity"), "3");
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
