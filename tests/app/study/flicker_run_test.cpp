// SPDX-License-Identifier: MIT
// Flicker along a camera path: of a known error, and as `grisaille measure --path` reports it.
#include "app/study/flicker_run.h"

#include <gtest/gtest.h>

#include "app/study/record.h"
#include "tests/core/trace/scene_builder.h"
#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app::study {
namespace {

constexpr const char* kPath =
    R"({"cameras": [{"eye": [-6.5, 1.75, 1.9], "target": [2.6, 2.35, -1.2], "fovy_degrees": 62},
        {"eye": [-6.4, 1.75, 1.9], "target": [2.6, 2.35, -1.2], "fovy_degrees": 62}],
        "frames": 3})";

TEST(FlickerAlong, AnErrorThatTurnsIsTwiceItsSize) {
  trace::SceneBuilder builder;
  builder.place(builder.floor(glm::vec3(0), 20, builder.material({})));
  const scene::CameraPath path = {.keys = {trace::cameraAt({1, 1, 1.5}, {0, 0.3, 0}),
                                           trace::cameraAt({1.1, 1, 1.5}, {0.1, 0.3, 0})},
                                  .frames = 4};
  std::vector<trace::FlickerFrame> frames;
  for (const scene::Camera& camera : scene::camerasOf(path)) {
    trace::FlickerFrame frame{.camera = camera, .hits = {}, .ao = {}, .truth = {}};
    frame.hits = trace::RayTracer(builder.scene, camera.eye).castPrimary(camera, 24, 16);
    frame.truth = {.width = 24, .height = 16, .channels = 1, .pixels = std::vector(24 * 16, 0.5f)};
    frames.push_back(std::move(frame));
  }
  size_t shown = 0;
  const auto along = [&](float error) {
    return flickerAlong(frames, [&, error](const scene::Camera&) {
      image::Image picture = frames[0].truth;
      for (float& value : picture.pixels) value += shown % 2 == 0 ? error : -error;
      ++shown;
      return picture;
    });
  };
  const trace::Flicker some = along(0.125f);
  EXPECT_NEAR(some.rms, 0.25, 1e-6);
  EXPECT_GT(some.points, 24u * 16u);
  EXPECT_EQ(shown, 4u);
  EXPECT_EQ(along(0).rms, 0);
  EXPECT_ERROR(ErrorId::kUsage, checkPathSize("path", 1000, {1280, 720}));
  EXPECT_NO_THROW(checkPathSize("path", 16, {1024, 1024}));
}

class MeasurePathTest : public testing::TestWithParam<const char*> {
 protected:
  tests::Outcome measure(const std::vector<std::string>& more) const {
    std::vector<std::string> all = {"measure",   "--size",  "96x54",
                                    "--samples", "32",      "--rounds",
                                    "1",         "--sweep", "ssao.kernel_size=2,32",
                                    "--out",     "study",   "--backend",
                                    GetParam()};
    all.insert(all.end(), more.begin(), more.end());
    return tests::runProgram(all, folder_.path(), {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  }
  tests::TemporaryFolder folder_;
};

TEST_P(MeasurePathTest, EverySettingHasItsFlicker) {
  folder_.write("path.json", kPath);
  const std::vector<std::string> options = {
      "--path", "path.json", "--set", "ssao.estimator=classic", "--set", "ssao.blur_size=0"};
  const tests::Outcome outcome = measure(options);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, double> flicker;
  for (const Record& record : loadAll(folder_.path() / "study")) {
    ASSERT_TRUE(record.flicker);
    flicker[nameOf(record.setting)] = *record.flicker;
  }
  ASSERT_EQ(flicker.size(), 2u);
  EXPECT_GT(flicker.at("kernel_size=32"), 0);
  EXPECT_GT(flicker.at("kernel_size=2"), 1.25 * flicker.at("kernel_size=32"));
  EXPECT_NE(tests::readFile(folder_ / "study/results.csv").find(",flicker,"), std::string::npos);
  EXPECT_NE(tests::readFile(folder_ / "study/results.json").find("\"flicker\""), std::string::npos);
  // The second run measures nothing again.
  const std::string results = tests::readFile(folder_ / "study/results.csv");
  ASSERT_EQ(measure(options).status, 0);
  EXPECT_EQ(tests::readFile(folder_ / "study/results.csv"), results);
}

TEST_P(MeasurePathTest, ABadPathIsNamed) {
  const auto refused = [&](const std::string& text, const std::string& number) {
    folder_.write("path.json", text);
    const tests::Outcome outcome = measure({"--path", "path.json"});
    EXPECT_EQ(outcome.status, number == "5101" ? 2 : 1);
    EXPECT_EQ(outcome.err.rfind("error E" + number + ": path.json: ", 0), 0u) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "study"));
  };
  refused("{", "2201");
  refused("{}", "2202");
  std::string many = kPath;
  refused(many.replace(many.rfind('3'), 1, "9999"), "5101");
}

INSTANTIATE_TEST_SUITE_P(, MeasurePathTest, testing::Values("opengl", "vulkan"));

}  // namespace
}  // namespace grisaille::app::study
