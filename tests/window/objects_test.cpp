// SPDX-License-Identifier: MIT
// Objects in the picture: selected, moved, edited, put into another order, deleted; every step is
// undone.
#include <fmt/format.h>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class ObjectsTest : public WindowTest {
 protected:
  std::vector<std::string> started() const {
    return arguments({"--effects", "ssao,sspm", "--set", "sspm.paint_range=0.2"});
  }
  // The panel has room for the objects without the effects' values.
  static void makeRoom(DrivenViewer& viewer) {
    viewer.click("section Effects");
    viewer.untilValue("section Effects", "closed");
    viewer.key("b");
    viewer.untilValue("sspm.placing", "true");
  }
  static void press(DrivenViewer& viewer, const std::string& keys, Point from, Point to) {
    const auto at = [](Point p) { return fmt::format("mousemove {} {} ", p.x, p.y); };
    viewer.send(at(from) + "keydown " + keys + " mousedown 1");
    viewer.untilDrawn();
    if (from.x != to.x || from.y != to.y) {
      // Two steps: what trembles is no drag.
      viewer.send(at({(from.x + to.x) / 2, (from.y + to.y) / 2}));
      viewer.untilDrawn();
      viewer.send(at(to));
      viewer.untilDrawn();
    }
    viewer.send("mouseup 1 keyup " + keys);
    viewer.untilDrawn();
  }
  static void shoot(DrivenViewer& viewer, Point at, const std::string& count) {
    viewer.click(at);
    viewer.untilValue("sspm.objects", count);
  }
  std::string savedObjects(DrivenViewer& viewer) {
    std::filesystem::remove(folder_ / "sspm.json");
    viewer.click("sspm.save");
    viewer.until("saved objects", [&](const nlohmann::json&) {
      return std::filesystem::exists(folder_ / "sspm.json");
    });
    return readFile(folder_ / "sspm.json");
  }
};
GRISAILLE_IN_WINDOWS(ObjectsTest);

TEST_P(ObjectsTest, AreSelectedAndMovedInThePicture) {
  DrivenViewer viewer(folder_, started());
  const Point left = viewer.at("picture", 0.25, 0.5), right = viewer.at("picture", 0.75, 0.5);
  const Point elsewhere = viewer.at("picture", 0.5, 0.7);
  makeRoom(viewer);
  shoot(viewer, left, "1");
  shoot(viewer, right, "2");
  viewer.untilValue("selected", "sspm 1");
  const std::string before = savedObjects(viewer);

  press(viewer, "ctrl", left, left);
  viewer.untilValue("selected", "sspm 0");
  EXPECT_EQ(viewer.value("sspm.objects"), "2");  // a click with Ctrl shoots nothing
  const auto near = [&](Point wanted) {
    const Point ring = viewer.middle("selected");
    return std::abs(ring.x - wanted.x) <= 3 && std::abs(ring.y - wanted.y) <= 3;
  };
  EXPECT_TRUE(near(left));
  EXPECT_EQ(savedObjects(viewer), before);

  press(viewer, "ctrl", left, elsewhere);
  viewer.untilValue("selected", "sspm 0");
  EXPECT_TRUE(near(elsewhere)) << viewer.layout()["selected"].dump();
  const std::string moved = savedObjects(viewer);
  EXPECT_NE(moved, before);
  viewer.key("ctrl+z");  // the whole drag is one step
  viewer.untilDrawn();
  EXPECT_TRUE(near(left));
  EXPECT_EQ(savedObjects(viewer), before);
  viewer.key("ctrl+shift+z");
  viewer.untilDrawn();
  EXPECT_EQ(savedObjects(viewer), moved);
  viewer.key("ctrl+z");
  viewer.untilDrawn();

  viewer.key("Delete");
  viewer.untilValue("sspm.objects", "1");
  viewer.key("ctrl+z");
  viewer.untilValue("sspm.objects", "2");
  EXPECT_EQ(savedObjects(viewer), before);
  viewer.key("Escape");
  viewer.until("no selection", [](const auto& now) { return !now.contains("selected"); });
  expectQuits(viewer);
}

TEST_P(ObjectsTest, AreOrderedAndEditedInTheList) {
  DrivenViewer viewer(folder_, started());
  makeRoom(viewer);
  shoot(viewer, viewer.at("picture", 0.3, 0.5), "1");
  shoot(viewer, viewer.at("picture", 0.7, 0.5), "2");
  const std::string before = savedObjects(viewer);
  viewer.click("sspm.list");
  viewer.untilValue("sspm.list", "open");
  viewer.untilValue("sspm.object.1", "true");
  viewer.click("sspm.earlier");
  viewer.untilValue("sspm.object.0", "true");
  const std::string ordered = savedObjects(viewer);
  EXPECT_NE(ordered, before);
  viewer.key("ctrl+z");
  viewer.untilDrawn();
  EXPECT_EQ(savedObjects(viewer), before);
  viewer.click("sspm.delete");
  viewer.untilValue("sspm.objects", "1");
  viewer.key("ctrl+z");
  viewer.untilValue("sspm.objects", "2");
  EXPECT_EQ(savedObjects(viewer), before);
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
