// SPDX-License-Identifier: MIT
// Two sides of one picture: two settings or two backends, their difference, and the backend of the
// window.
#include <filesystem>
#include <thread>

#include "app/truth/error_map.h"
#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class SplitTest : public WindowTest {
 protected:
  static std::string other() { return GetParam() == "opengl" ? "vulkan" : "opengl"; }
  static std::string label(const std::string& backend) {
    return backend == "opengl" ? "OpenGL" : "Vulkan";
  }
  static bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  static double rmseOf(const DrivenViewer& viewer) {
    const std::string text = viewer.value("split numbers"), key = "RMSE ";
    return std::stod(text.substr(text.find(key) + key.size()));
  }
  // Waits until a window of this backend shows the picture, and gives it the keys.
  static void untilBackend(DrivenViewer& viewer, const std::string& backend) {
    viewer.untilValue("backend", backend);
    viewer.focus();
  }
};
GRISAILLE_IN_WINDOWS(SplitTest);

TEST_P(SplitTest, HeldSettingsAreComparedByNumbersAndColours) {
  DrivenViewer viewer(folder_,
                      arguments({"--effects", "ssao", "--view", "ssao.ao", "--split", "ssao.ao"}));
  viewer.click("hold");
  viewer.drag(viewer.at("ssao.intensity", 0.5, 0.5), viewer.at("ssao.intensity", 0.8, 0.5));
  viewer.untilChanged("ssao.intensity", "1");
  EXPECT_TRUE(holds(viewer.value("label left"), "A: ssao.ao, live")) << viewer.layout().dump();
  EXPECT_TRUE(holds(viewer.value("label right"), "B: ssao.ao, held")) << viewer.layout().dump();
  const image::Image live = image::read(viewer.savePicture());
  viewer.click("swap");
  viewer.untilValue("ssao.intensity", "1");
  const image::Image held = image::read(viewer.savePicture());
  viewer.click("swap");
  viewer.untilChanged("ssao.intensity", "1");
  const double expected = image::compare(live, held).rmse;
  EXPECT_GT(expected, 0.01);
  EXPECT_NEAR(rmseOf(viewer), expected, 1e-4 * expected);

  viewer.key("Escape shift+x");
  viewer.untilValue("split way", "difference");
  EXPECT_TRUE(holds(viewer.value("split legend"), "-0.25 A is darker")) << viewer.layout().dump();
  rest(viewer);
  const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<uint32_t>>();
  const uint32_t width = rect[2] - rect[0], height = rect[3] - rect[1];
  ASSERT_EQ(live.width, width);
  const std::vector<uint32_t> screen = display_.pixels(rect[0], rect[1], width, height);
  const double labels = viewer.layout()["label left"]["rect"][1].get<double>();
  size_t off = 0;
  for (size_t i = 0; i < size_t{width} * static_cast<size_t>(labels); ++i) {
    if (i % width + 100 > width && i / width < 100) continue;  // the axes
    const glm::vec3 color = app::truth::errorColor(live.pixels[i] - held.pixels[i]) * 255.0f;
    for (int c = 0; c < 3; ++c) {
      off += std::abs(static_cast<float>(screen[i] >> (16 - 8 * c) & 255u) - color[c]) > 1 ? 1 : 0;
    }
  }
  EXPECT_EQ(off, 0u);

  // One after the other.
  viewer.key("shift+x");
  viewer.untilValue("split way", "flicker");
  for (const char* side : {"left", "right", "left"}) {
    viewer.until(side, [&](const nlohmann::json& now) {
      return now.contains(std::string("label ") + side);
    });
  }
  viewer.key("shift+x");
  viewer.untilValue("split way", "line");
  expectQuits(viewer);
}

TEST_P(SplitTest, TheValueAtThePointerIsShownOfBothSides) {
  DrivenViewer viewer(folder_,
                      arguments({"--effects", "ssao", "--view", "depth", "--split", "ssao.ao"}));
  EXPECT_TRUE(holds(viewer.value("split numbers"), "different units")) << viewer.layout().dump();
  viewer.key("i");
  const Point at = viewer.at("picture", 0.6, 0.5);
  viewer.send("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y));
  viewer.untilThere("value right");
  const auto number = [&](const std::string& name, char side) {
    const std::string text = viewer.value(name);
    return std::stod(text.substr(text.find(side) + 1));
  };
  EXPECT_GT(number("value left", 'A'), 0.5);  // metres
  EXPECT_GE(number("value right", 'B'), 0);
  EXPECT_LE(number("value right", 'B'), 1);
  // The numbers are in sight at the bottom of the panel, below all controls.
  const auto rect = viewer.layout()["value right"]["rect"].get<std::vector<double>>();
  EXPECT_LT(rect[3], 1680);
  EXPECT_GT(rect[1], 1400);
  expectQuits(viewer);
}

TEST_P(SplitTest, ASideCanBeOfAnotherBackend) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--view", "ssao.ao", "--split",
                                          "ssao.ao", "--split-backend", other()}));
  EXPECT_TRUE(holds(viewer.value("label left"), label(GetParam()))) << viewer.layout().dump();
  EXPECT_TRUE(holds(viewer.value("label right"), label(other()))) << viewer.layout().dump();
  const auto rendered = [&](const std::string& backend) {
    std::vector<std::string> command = {"render",
                                        "--backend",
                                        backend,
                                        "--effects",
                                        "ssao",
                                        "--set",
                                        "ssao.kernel_size=6",
                                        "--set",
                                        "ssao.radius=" + viewer.value("ssao.radius"),
                                        "--write",
                                        "ssao.ao=" + backend + ".exr"};
    const auto more = view(viewer);
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = runProgram(command, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return image::read(folder_ / (backend + ".exr"));
  };
  const double expected = image::compare(rendered("opengl"), rendered("vulkan")).rmse;
  EXPECT_NEAR(rmseOf(viewer), expected, 1e-4 * expected + 1e-7);
  // Both follow the panel, and shots.
  viewer.drag(viewer.at("ssao.intensity", 0.5, 0.5), viewer.at("ssao.intensity", 0.9, 0.5));
  viewer.untilChanged("ssao.intensity", "1");
  EXPECT_LT(rmseOf(viewer), 0.02);
  choose(viewer, "right backend", "window");
  viewer.untilValue("right backend", "");
  EXPECT_EQ(rmseOf(viewer), 0);
  expectQuits(viewer);
}

TEST_P(SplitTest, AnotherBackendKeepsEverything) {
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao,sspm", "--split", "normal"}));
  change(viewer);
  viewer.click("section View");
  viewer.untilValue("section View", "closed");
  rest(viewer);
  const auto kept = [&] {
    nlohmann::json all = viewer.layout();
    for (const char* changing : {"drawn", "backend", "message", "focus", "tooltip", "value none"}) {
      all.erase(changing);
    }
    nlohmann::json values;
    for (const auto& [name, control] : all.items()) {
      if (!name.starts_with("cost.")) values[name] = control.value("value", "");
    }
    return values;
  };
  const nlohmann::json before = kept();
  const std::string first = viewer.savePicture();
  choose(viewer, "backend", other());
  untilBackend(viewer, other());
  EXPECT_EQ(kept(), before);
  const double off = image::compare(image::read(first), image::read(viewer.savePicture())).rmse;
  EXPECT_LT(off, 0.02);
  choose(viewer, "backend", GetParam());
  untilBackend(viewer, GetParam());
  EXPECT_EQ(kept(), before);
  expectSame(first, viewer.savePicture());
  // Steps of undo go back to before.
  viewer.key("Escape ctrl+z");
  viewer.untilValue("ssao.intensity", "1");
  viewer.key("ctrl+z");
  viewer.untilValue("sspm.objects", "0");
  expectQuits(viewer);
}

TEST_P(SplitTest, ABackendThatDoesNotStartChangesNothing) {
  const std::string library = other() == "opengl" ? "libEGL.so" : "libvulkan.so";
  DrivenViewer viewer(folder_, arguments({"--effects", "ssao", "--split", "color"}),
                      {"LD_PRELOAD=" HIDE_LIBRARY, "HIDE_LIBRARY=" + library});
  const std::string camera = viewer.value("camera");
  choose(viewer, "backend", other());
  viewer.untilThere("error");
  EXPECT_EQ(viewer.value("backend"), GetParam());
  EXPECT_EQ(viewer.value("camera"), camera);
  viewer.key("Escape Left");
  viewer.untilChanged("camera", camera);
  choose(viewer, "right backend", other());
  viewer.until("an error about the right side", [](const nlohmann::json& now) {
    return now.contains("error") && holds(now["error"]["value"], "the right side");
  });
  viewer.untilValue("right backend", "");
  const Outcome outcome = viewer.quit();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
