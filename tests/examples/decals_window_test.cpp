// SPDX-License-Identifier: MIT
// The example of an effect with objects in the viewer: a decal is placed by a click, edited,
// undone, deleted, saved and loaded.
#include "tests/window/window_test.h"

#include "tests/examples/built.h"

namespace grisaille::tests {
namespace {

class DecalsWindow : public WindowTest {
 protected:
  void SetUp() override {
    GRISAILLE_NEEDS_INSTALLATION();
    builtExample("decals");
    writePng(squares({kRed, kRed, kRed, kRed}), folder_, "red.png");
    writePng(squares({kBlue, kBlue, kBlue, kBlue}), folder_, "blue.png");
  }
  // Compares the middle pixel of the viewer's picture with this colour.
  static void expectMiddle(DrivenViewer& viewer, const Colour& colour) {
    const image::Image image = image::read(viewer.savePicture());
    for (uint32_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(image.at(image.width / 2, image.height / 2, c), linear(colour[c]), 0.005) << c;
    }
  }
  static void type(DrivenViewer& viewer, const std::string& field, const std::string& text) {
    viewer.clickText(field);
    viewer.key("ctrl+a");
    viewer.type("'" + text + "'");
  }
};
GRISAILLE_IN_WINDOWS(DecalsWindow);

constexpr const char* kWindowCamera =
    R"({"eye": [-1.5, 2, -1.5], "target": [-1.5, 0, -1.5], "up": [0, 0, -1], "fovy_degrees": 30})";

TEST_P(DecalsWindow, ADecalIsPlacedEditedUndoneDeletedSavedAndLoaded) {
  DrivenViewer viewer(
      folder_, {"--backend", GetParam(), "--size", kWindow, "--plugin-path", builtExample("decals"),
                "--effects", "decals", "--camera", kWindowCamera, "--view", "decals.decals"});
  type(viewer, "decals.next.picture", "red.png");
  viewer.key("Return");
  viewer.untilValue("decals.next.picture", "red.png");
  viewer.click("decals.placing");
  viewer.untilValue("decals.placing", "true");
  viewer.click("picture");
  viewer.untilValue("decals.objects", "1");
  expectMiddle(viewer, kRed);
  viewer.key("ctrl+z");
  viewer.untilValue("decals.objects", "0");
  expectMiddle(viewer, {0, 0, 0, 0});
  viewer.key("ctrl+shift+z");
  viewer.untilValue("decals.objects", "1");
  // The object that was placed last is selected.
  viewer.click(viewer.at("decals.list", 0.05, 0.5));
  viewer.untilValue("decals.object.0", "true");
  // A path applies when Enter is pressed; the incomplete paths before cause no warning.
  type(viewer, "decals.field.picture", "blue.png");
  expectMiddle(viewer, kRed);
  viewer.key("Return");
  viewer.untilValue("decals.field.picture", "blue.png");
  expectMiddle(viewer, kBlue);
  type(viewer, "decals.field.name", "moss");
  viewer.click(viewer.at("decals.list", 0.05, 0.5));
  viewer.click(viewer.at("decals.list", 0.05, 0.5));
  viewer.untilValue("decals.field.name", "moss");
  viewer.click("decals.save");
  viewer.untilValue("message", "1 decals to decals.json");
  const std::string saved = readFile(folder_ / "decals.json");
  EXPECT_NE(saved.find(R"("picture": "blue.png", "name": "moss")"), std::string::npos) << saved;
  viewer.click("decals.delete");
  viewer.untilValue("decals.objects", "0");
  viewer.click("decals.load");
  viewer.untilValue("decals.objects", "1");
  expectMiddle(viewer, kBlue);
  // Each edit was one step.
  for (const char* objects : {"0", "1", "1", "1", "0"}) {
    viewer.key("ctrl+z");
    viewer.untilValue("decals.objects", objects);
  }
  expectQuits(viewer);
}

TEST_P(DecalsWindow, APictureThatCannotBeReadIsToldInThePanel) {
  folder_.write("lost.json",
                R"({"version": 1, "decals": [{"position": [0, 0, 0], "picture": "lost.png"}]})");
  DrivenViewer viewer(
      folder_, {"--backend", GetParam(), "--size", kWindow, "--plugin-path", builtExample("decals"),
                "--effects", "decals", "--load", "decals=lost.json"});
  viewer.until("a warning", [](const nlohmann::json& now) {
    return now.contains("message") &&
           now["message"]["value"].get<std::string>().find("lost.png") != std::string::npos;
  });
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
