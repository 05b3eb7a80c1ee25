// SPDX-License-Identifier: MIT
// Text of any size, on screens of any resolution: every control is inside the window and beside the
// others.
#include <fmt/format.h>

#include <cmath>
#include <glm/glm.hpp>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

struct Rect {
  std::string name;
  double left, top, right, bottom;
};

class ScaleTest : public WindowTest {
 protected:
  static std::vector<Rect> controls(const DrivenViewer& viewer) {
    std::vector<Rect> all;
    const nlohmann::json layout = viewer.layout();
    for (const auto& [name, control] : layout.items()) {
      if (!control.contains("id")) continue;
      const auto r = control["rect"].get<std::vector<double>>();
      all.push_back({name, r[0], r[1], r[2], r[3]});
    }
    return all;
  }
  // A row of the list of effects lies under its arrows, and the ends of the axes may meet.
  static bool mayOverlap(const std::string& name) {
    return name.ends_with(".tree") || name.starts_with("axis ") || name == "panel border";
  }
  static void expectReadable(const DrivenViewer& viewer) {
    const nlohmann::json layout = viewer.layout();
    const auto right = [&](const std::string& name) {
      return layout[name]["rect"].get<std::vector<double>>()[2];
    };
    // A heading fills the panel's width between border and scroll bar.
    const double window = right("picture"), content = right("section Effects");
    const std::vector<Rect> all = controls(viewer);
    EXPECT_GT(all.size(), 4u);
    for (const Rect& a : all) {
      EXPECT_GE(a.left, 0) << a.name;
      EXPECT_GE(a.top, 0) << a.name;
      const bool inPicture = a.name.starts_with("axis ") || a.name == "panel border";
      EXPECT_LE(a.right, inPicture ? window : content + 8) << a.name;  // rows reach into the gaps
      for (const Rect& b : all) {
        if (&a == &b || mayOverlap(a.name) || mayOverlap(b.name)) continue;
        const bool apart =
            a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
        EXPECT_TRUE(apart) << a.name << " and " << b.name << " overlap";
      }
    }
  }
};
GRISAILLE_IN_WINDOWS(ScaleTest);

TEST_P(ScaleTest, NothingIsCutOrOverlaps) {
  struct Screen {
    const char* size;
    double scale;
  };
  for (const Screen& screen : {Screen{"1280x720", 1}, {"1920x1080", 1}, {"3840x2160", 2}}) {
    SCOPED_TRACE(screen.size);
    display_.setScale(screen.scale);
    DrivenViewer viewer(folder_, {"--fresh", "--backend", GetParam(), "--size", screen.size,
                                  "--effects", "ssao,sspm", "--preset", "ssao=fast"});
    expectReadable(viewer);
    // One section at a time, so that nothing of it is out of sight.
    std::string open = "section Effects";
    for (const char* name :
         {"View", "Objects", "Settings", "Cost", "Camera", "Sequence", "Scene"}) {
      SCOPED_TRACE(name);
      if (viewer.value(open) == "open") viewer.click(open);
      viewer.untilValue(open, "closed");
      open = std::string("section ") + name;
      viewer.untilThere(open);
      if (viewer.value(open) == "closed") viewer.click(open);
      viewer.untilValue(open, "open");
      expectReadable(viewer);
    }
    viewer.drag(viewer.at("panel border", 0.5, 0.5),
                {viewer.at("panel border", 0.5, 0.5).x + 100, 300});
    expectReadable(viewer);
    expectQuits(viewer);
  }
}

// The window follows the text, so that the picture keeps its size.
TEST_P(ScaleTest, TheWindowFollowsTheText) {
  DrivenViewer viewer(folder_, {"--fresh", "--backend", GetParam(), "--size", "900x700",
                                "--effects", "ssao", "--set", "ssao.kernel_size=2"});
  const auto rect = [&] { return viewer.layout()["picture"]["rect"].get<std::vector<double>>(); };
  const std::vector<double> before = rect();
  // Presses keys and waits until the picture begins at `x`: the frame of an earlier key may be
  // drawn after the last one is sent.
  const auto press = [&](const std::string& keys, int times, double x, double within) {
    for (int i = 0; i < times; ++i) viewer.key(keys);
    viewer.until("a picture at x = " + std::to_string(x), [&](const nlohmann::json& now) {
      return std::abs(now["picture"]["rect"][0].get<double>() - x) <= within;
    });
    viewer.untilDrawn();
    EXPECT_NEAR(rect()[0], x, within);
  };
  const auto expectSamePicture = [&] {
    const std::vector<double> now = rect();
    EXPECT_NEAR(now[2] - now[0], before[2] - before[0], 4);
    EXPECT_EQ(now[3], before[3]);
  };
  press("ctrl+plus", 8, before[0] * std::pow(1.1, 8), 0.05 * before[0]);  // 2.1 times
  expectSamePicture();
  press("ctrl+plus", 8, 4 * before[0], 2);  // as large as text can be
  expectSamePicture();
  expectReadable(viewer);
  press("ctrl+0", 1, before[0], 0);
  EXPECT_EQ(rect(), before);
  press("ctrl+minus", 9, before[0] / 2, 2);  // as small
  expectSamePicture();
  expectReadable(viewer);
  expectQuits(viewer);
}

// A window that nobody has sized is as large on every screen.
TEST_P(ScaleTest, AFirstWindowIsAsLargeOnEveryScreen) {
  display_.setScale(2);
  DrivenViewer viewer(folder_,
                      {"--backend", GetParam(), "--effects", "ssao", "--preset", "ssao=fast"});
  const auto rect = viewer.layout()["picture"]["rect"].get<std::vector<double>>();
  EXPECT_EQ(rect[2], 3200);
  EXPECT_EQ(rect[3], 1800);
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
