// SPDX-License-Identifier: MIT
// How finely the viewer draws: at half the resolution while the picture moves, if frames take long;
// the mean of many frames while it rests.
#include <future>
#include <thread>

#include "tests/window/window_test.h"

namespace grisaille::tests {
namespace {

class FinenessTest : public WindowTest {
 protected:
  // A picture that takes far over 50 ms on every software driver.
  std::vector<std::string> slow() const {
    return {"--backend", GetParam(), "--size",         "1300x1680", "--effects",
            "ssao",      "--preset", "ssao=reference", "--view",    "ssao.ao"};
  }
  // Until the camera has moved and rests. The same scale of the picture in successive frames counts
  // once.
  static std::vector<std::string> scalesDuring(DrivenViewer& viewer, const std::string& words) {
    std::vector<std::string> scales = {viewer.value("scale")};
    const std::string before = viewer.value("camera");
    auto sent =
        std::async(std::launch::async, [&] { return std::system(("xdotool " + words).c_str()); });
    const auto look = [&] {
      const std::string now = viewer.value("scale");
      if (now != scales.back()) scales.push_back(now);
    };
    while (sent.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) look();
    EXPECT_EQ(sent.get(), 0);
    viewer.until("rest", [&](const nlohmann::json& now) {
      look();
      return now["camera"]["value"] != before && now["picture"]["value"] == "done" &&
             now["scale"]["value"] == "1";
    });
    return scales;
  }
  // A drag of the left button in the picture, `steps` times a few pixels.
  static std::string dragged(const DrivenViewer& viewer, int steps) {
    const Point at = viewer.at("picture", 0.5, 0.5);
    std::string words =
        "mousemove " + std::to_string(at.x) + " " + std::to_string(at.y) + " mousedown 1 ";
    for (int i = 0; i < steps; ++i) words += "mousemove_relative 6 1 sleep 0.04 ";
    return words + "mouseup 1";
  }
  std::string rendered(const DrivenViewer& viewer, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "--backend", GetParam(), "--effects", "ssao", "--write",
                               "ssao.ao=r.exr"});
    const auto seen = view(viewer);
    more.insert(more.end(), seen.begin(), seen.end());
    const Outcome outcome = runProgram(more, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder_ / "r.exr";
  }
};
GRISAILLE_IN_WINDOWS(FinenessTest);

TEST_P(FinenessTest, AMovingPictureIsCoarseUntilItRests) {
  DrivenViewer viewer(folder_, slow());
  const std::string camera = viewer.value("camera");
  // Once coarse, it stays so until the end of the drag: it does not flicker.
  const std::vector<std::string> once = {"1", "2", "1"}, never = {"1"};
  EXPECT_EQ(scalesDuring(viewer, dragged(viewer, 30)), once);
  EXPECT_NE(viewer.value("camera"), camera);
  expectSame(viewer.savePicture(), rendered(viewer, {"--preset", "ssao=reference"}));
  // The camera jumps; nothing moves.
  EXPECT_EQ(scalesDuring(viewer, "key Home"), never);
  EXPECT_EQ(viewer.value("camera"), camera);
  viewer.click("halves");
  viewer.untilValue("halves", "false");
  EXPECT_EQ(scalesDuring(viewer, dragged(viewer, 8)), never);
  expectQuits(viewer);
}

TEST_P(FinenessTest, APictureAtRestAveragesItsHistory) {
  const std::vector<std::string> settings = {
      "--set", "ssao.blur_size=0", "--set", "ssao.kernel_size=4", "--set", "ssao.resolution=full"};
  std::vector<std::string> started =
      arguments({"--effects", "ssao", "--view", "ssao.ao", "--set", "ssao.history=24"});
  started.insert(started.end(), settings.begin(), settings.end());
  DrivenViewer viewer(folder_, started);
  EXPECT_EQ(viewer.value("averaged"), "24");
  const auto rmse = [&](const std::string& file, const std::string& other) {
    return image::compare(image::read(file), image::read(other)).rmse;
  };
  const auto render = [&](std::vector<std::string> more) {
    more.insert(more.end(), settings.begin(), settings.end());
    return rendered(viewer, more);
  };
  const std::string limit = folder_ / "limit.exr";
  std::filesystem::rename(render({"--set", "ssao.history=256", "--frames", "256"}), limit);
  const double alone = rmse(render({}), limit);
  EXPECT_LT(rmse(viewer.savePicture(), limit), alone / 3);
  // It rests then.
  const std::string drawn = viewer.value("drawn");
  viewer.send("sleep 1");
  EXPECT_EQ(viewer.value("drawn"), drawn);

  // Without a history, a picture is a single frame, unless the user wants it to converge.
  viewer.click("ssao.history", 3);
  viewer.untilValue("ssao.history", "1");
  EXPECT_EQ(viewer.value("averaged"), "");
  expectSame(viewer.savePicture(), render({}));
  viewer.click("converges");
  viewer.untilValue("averaged", "256");
  EXPECT_LT(rmse(viewer.savePicture(), limit), alone / 20);
  expectQuits(viewer);
}

}  // namespace
}  // namespace grisaille::tests
