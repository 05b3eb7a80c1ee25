// SPDX-License-Identifier: MIT
// The example of an effect with objects on the command line, with both backends.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "tests/examples/built.h"

namespace grisaille::tests {
namespace {

// A tile of the atrium's floor, seen from above. Up is -z in the decal's picture and in the camera.
constexpr const char* kAbove =
    R"({"eye": [-1.5, 2, -1.5], "target": [-1.5, 0, -1.5], "up": [0, 0, -1], "fovy_degrees": 30})";
constexpr uint32_t kWidth = 96, kHeight = 64;

class Decals : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    GRISAILLE_NEEDS_INSTALLATION();
    builtExample("decals");
    writePng(squares({kRed, kGreen, kBlue, kGrey}), folder_, "squares.png");
    writePng(squares({kRed, kRed, kRed, kRed}), folder_, "red.png");
    writePng(squares({kBlue, kBlue, kBlue, kBlue}), folder_, "blue.png");
  }

  Outcome run(const std::vector<std::string>& more, const std::string& camera = kAbove,
              const std::string& backend = GetParam()) {
    std::vector<std::string> all = {"render",
                                    "--backend",
                                    backend,
                                    "--plugin-path",
                                    builtExample("decals"),
                                    "--effects",
                                    "decals",
                                    "--camera",
                                    camera,
                                    "--size",
                                    fmt::format("{}x{}", kWidth, kHeight),
                                    "--check",
                                    "--write",
                                    "decals=decals.exr"};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(all, folder_.path());
  }
  image::Image drawn(const std::vector<std::string>& more, const std::string& camera = kAbove,
                     const std::string& backend = GetParam()) {
    const Outcome outcome = run(more, camera, backend);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return image::read(folder_ / "decals.exr");
  }

  static void expectColour(const image::Image& image, uint32_t x, uint32_t y,
                           const Colour& colour) {
    for (uint32_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(image.at(x, y, c), linear(colour[c]), 0.002) << x << ", " << y << ", " << c;
    }
    EXPECT_NEAR(image.at(x, y, 3), static_cast<float>(colour[3]) / 255, 0.002) << x << ", " << y;
  }

  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, Decals, ::testing::Values("opengl", "vulkan"),
                         [](const auto& of) { return of.param; });

TEST_P(Decals, APixelHasTheColourOfThePicturesPoint) {
  const image::Image upright = drawn({"--add", "decals=48,32,picture=squares.png,size=0.5"});
  expectColour(upright, 44, 28, kRed);
  expectColour(upright, 52, 28, kGreen);
  expectColour(upright, 44, 36, kBlue);
  expectColour(upright, 52, 36, kGrey);
  // At a distance of 2 m, 64 pixels span 2 * 2 * tan(15 degrees) m.
  const double side = 0.5 / (4 * std::tan(M_PI / 12)) * 64;
  float covered = 0;
  for (size_t i = 3; i < upright.pixels.size(); i += 4) covered += upright.pixels[i];
  EXPECT_NEAR(covered, side * side, 0.02 * side * side);
  const image::Image turned =
      drawn({"--add", "decals=48,32,picture=squares.png,size=0.5,angle=1.5707963"});
  expectColour(turned, 44, 28, kGreen);
  expectColour(turned, 44, 36, kRed);
  const image::Image wide =
      drawn({"--add", "decals=48,32,picture=squares.png,size=1,height=0.2,opacity=0.5"});
  expectColour(wide, 20, 30, {kRed[0], kRed[1], kRed[2], 128});
  EXPECT_EQ(wide.at(20, 20, 3), 0);
}

TEST_P(Decals, TheHighestOrderIsOnTopAndOfEqualOnesTheLatest) {
  const auto both = [&](const std::string& first, const std::string& second) {
    return drawn({"--add", "decals=48,32,picture=red.png" + first, "--add",
                  "decals=48,32,picture=blue.png" + second});
  };
  expectColour(both("", ""), 48, 32, kBlue);
  expectColour(both(",order=1", ""), 48, 32, kRed);
  expectColour(both(",order=-2", ",order=-3"), 48, 32, kRed);
}

TEST_P(Decals, WhatIsSavedIsLoaded) {
  const image::Image added =
      drawn({"--add", "decals=40,30,picture=squares.png,size=0.3,angle=0.7", "--add",
             "decals=60,30,picture=red.png,opacity=0.3", "--save", "decals=d.json"});
  EXPECT_EQ(image::compare(added, drawn({"--load", "decals=d.json"})).largest, 0);
}

TEST_P(Decals, PicturesThatCannotBeReadAreSquaresAndNoFailure) {
  folder_.write("broken.png", "no picture");
  const Outcome outcome =
      run({"--add", "decals=30,32,picture=missing.png,size=0.2", "--add",
           "decals=60,32,picture=broken.png,size=0.2", "--add", "decals=48,10,size=0.2", "--add",
           "decals=48,50,picture=red.png,size=0.2"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("missing.png"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("broken.png"), std::string::npos) << outcome.err;
  const image::Image image = image::read(folder_ / "decals.exr");
  for (const auto& [x, y] : {std::pair{28u, 32u}, {58u, 32u}, {46u, 10u}}) {
    expectColour(image, x, y, {204, 0, 204, 255});
    expectColour(image, x + 5, y, {0, 0, 0, 255});
  }
  expectColour(image, 48, 50, kRed);
}

TEST_P(Decals, NoneDrawNothing) {
  for (const float value : drawn({}).pixels) EXPECT_EQ(value, 0);
}

// A distant picture of fine stripes shows their mean.
TEST_P(Decals, DistantPicturesDoNotAlias) {
  image::Image8 stripes{.width = 1024, .height = 1024, .pixels = {}};
  for (size_t i = 0; i < size_t{1024} * 1024; ++i) {
    const uint8_t light = i % 2 == 0 ? 255 : 0;
    stripes.pixels.insert(stripes.pixels.end(), {light, light, light, 255});
  }
  writePng(stripes, folder_, "stripes.png");
  const image::Image image = drawn({"--add", "decals=48,32,picture=stripes.png,size=0.5"});
  for (uint32_t x = 40; x < 56; ++x) EXPECT_NEAR(image.at(x, 32), 0.5, 0.01) << x;
}

// Many decals at all angles, all over the atrium.
TEST_P(Decals, BackendsAgree) {
  if (GetParam() != "vulkan") GTEST_SKIP() << "the run on vulkan compares both backends";
  std::string json = R"({"version": 1, "decals": [)";
  for (int i = 0; i < 300; ++i) {
    const bool wall = i % 3 == 0;
    const glm::dvec3 place(std::sin(i * 1.7) * 9, wall ? 2 + std::sin(i) : 0,
                           std::sin(i * 2.3) * 5);
    const glm::dvec3 out = wall ? glm::dvec3(std::sin(i), 0, std::cos(i)) : glm::dvec3(0, 1, 0);
    json += fmt::format(
        R"({}{{"position": [{}, {}, {}], "direction": [{}, {}, {}], "angle": {}, "size": {}, "picture": "{}", "opacity": {}}})",
        i == 0 ? "" : ", ", place.x, place.y, place.z, out.x, out.y, out.z, i * 0.01,
        0.3 + 0.002 * i, i % 2 == 0 ? "squares.png" : "red.png", 0.5 + 0.5 * std::cos(i));
  }
  folder_.write("many.json", json + "]}");
  const std::string camera =
      R"({"eye": [-6.5, 1.75, 1.9], "target": [2.6, 1.5, -0.5], "fovy_degrees": 60})";
  const image::Image one = drawn({"--load", "decals=many.json"}, camera);
  const image::Image other = drawn({"--load", "decals=many.json"}, camera, "opengl");
  float most = 0, covered = 0;
  for (size_t i = 3; i < one.pixels.size(); i += 4) covered += one.pixels[i] > 0 ? 1.0f : 0.0f;
  for (size_t i = 0; i < one.pixels.size(); ++i) {
    most = std::max(most, std::abs(one.pixels[i] - other.pixels[i]));
  }
  std::printf("largest difference %.5f, pixels %.0f\n", most, covered);
  EXPECT_GT(covered, 500);
  EXPECT_LT(most, 0.02);
}

}  // namespace
}  // namespace grisaille::tests
