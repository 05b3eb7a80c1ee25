// SPDX-License-Identifier: MIT
// The example that reads the colour of the picture and writes a new one.
#include <cmath>

#include "tests/examples/example_host.h"

namespace grisaille::tests {
namespace {

// Looks along -z at walls that face it. A pixel spans d / 64 m at a distance of d.
class DepthOfFieldHost : public ExampleHost {
 protected:
  void SetUp() override {
    GRISAILLE_NEEDS_INSTALLATION();
    start("depth_of_field");
  }
  static constexpr double kMiddle = kWidth / 2.0;

  // A lens that blurs a wall at `depth` by a disc of this radius.
  void focus(host::Effect& effect, double metres, double depth, double radius) const {
    effect.set("focus", metres);
    effect.set("aperture", 2 * radius * metres / std::abs(depth - metres) * depth / kHeight);
    effect.set("samples", 256.0);
  }
  std::vector<float> through(host::Effect& effect, const host::Texture& depth,
                             const host::Texture& colour) {
    return record(effect, {.camera = camera_, .depth = depth, .colour = &colour});
  }
  // Of the middle row.
  static float at(const std::vector<float>& texels, uint32_t x) {
    return texels[4 * (size_t{kHeight} / 2 * kWidth + x)];
  }

  const glm::dmat4 view_ = glm::dmat4(1);
  const glm::dmat4 projection_ =
      projectionOf({.angle = 2 * std::atan(0.5)}, double{kWidth} / kHeight, {.near = 0.1});
  const host::Camera camera_{&view_[0][0], &projection_[0][0]};
};
GRISAILLE_IN_EVERY_HOST(DepthOfFieldHost);

double step(double x, double) {
  return x < 48 ? 0 : 1;
}

TEST_P(DepthOfFieldHost, TheSurfaceInFocusStaysAsItIs) {
  host::Effect effect = this->effect();
  effect.set("focus", 3.0);
  effect.set("aperture", 0.5);
  const auto pattern = [](double x, double y) { return std::fmod(7 * x + 3 * y, 16) / 16; };
  const std::vector<float> sharp =
      through(effect, numbers([](double, double) { return 3; }), colours(pattern));
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const size_t texel = 4 * (size_t{y} * kWidth + x);
      ASSERT_EQ(sharp[texel], static_cast<float>(pattern(x + 0.5, y + 0.5))) << x << ", " << y;
      ASSERT_EQ(sharp[texel + 3], 1) << x << ", " << y;
    }
  }
}

// An edge under a disc of radius r: the share of the disc on either side.
TEST_P(DepthOfFieldHost, ABlurredEdgeIsThatOfADisc) {
  const double r = 10;
  for (const double depth : {2.0, 6.0}) {  // in front of the focus, and behind it
    host::Effect effect = this->effect();
    focus(effect, 3, depth, r);
    const std::vector<float> blurred =
        through(effect, numbers([&](double, double) { return depth; }), colours(step));
    for (int x = 20; x < 76; ++x) {
      const double from = std::clamp((x + 0.5 - kMiddle) / r, -1.0, 1.0);
      const double share =
          0.5 + (from * std::sqrt(1 - from * from) + std::asin(from)) / 3.14159265358979;
      EXPECT_NEAR(at(blurred, static_cast<uint32_t>(x)), share, 0.03) << depth << " m, " << x;
    }
  }
}

TEST_P(DepthOfFieldHost, LightStaysOutOfSharpSurfacesInFront) {
  host::Effect effect = this->effect();
  focus(effect, 2, 8, 12);
  const std::vector<float> blurred =
      through(effect, numbers([](double x, double) { return x < 48 ? 2 : 8; }), colours(step));
  for (uint32_t x = 0; x < 46; ++x) EXPECT_LT(at(blurred, x), 0.01) << x;
}

TEST_P(DepthOfFieldHost, BlurredSurfacesInFrontReachOverTheirEdge) {
  host::Effect effect = this->effect();
  focus(effect, 8, 2, 12);
  const std::vector<float> blurred =
      through(effect, numbers([](double x, double) { return x < 48 ? 8 : 2; }), colours(step));
  EXPECT_GT(at(blurred, 44), 0.15);
  EXPECT_GT(at(blurred, 40), 0.03);
  EXPECT_LT(at(blurred, 34), 0.01);
}

TEST_P(DepthOfFieldHost, RowsMayBeginAtTheBottom) {
  std::vector<std::vector<float>> pictures;
  for (const bool flipped : {false, true}) {
    const auto row = [&](double y) { return flipped ? kHeight - y : y; };
    host::Effect effect =
        this->effect(flipped ? GRISAILLE_HOST_ROWS_FROM_BOTTOM : GRISAILLE_HOST_ROWS_FROM_TOP);
    effect.set("focus", 2.0);
    effect.set("aperture", 0.2);
    pictures.push_back(
        through(effect, numbers([&](double x, double y) { return 2 + 0.01 * x + 0.05 * row(y); }),
                colours([&](double x, double y) { return step(x + 0.5 * row(y), 0); })));
  }
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t i = 0; i < 4 * kWidth; ++i) {
      ASSERT_EQ(pictures[0][size_t{y} * 4 * kWidth + i],
                pictures[1][size_t{kHeight - 1 - y} * 4 * kWidth + i]);
    }
  }
}

TEST_P(DepthOfFieldHost, WithoutAColourTheErrorNamesIt) {
  host::Effect effect = this->effect();
  const host::Texture depth = numbers([](double, double) { return 3; });
  expectLacks(effect, {.camera = camera_, .depth = depth},
              "depth_of_field reads the lit colour, but frame.colour is null");
  const host::Texture colour = colours(step);
  EXPECT_EQ(at(through(effect, depth, colour), 90), 1) << "it runs once the colour is there";
}

class DepthOfField : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { GRISAILLE_NEEDS_INSTALLATION(); }
  image::Image render(const std::string& effects, const std::vector<std::string>& more = {},
                      const std::string& backend = GetParam()) {
    std::vector<std::string> words = {
        "render",    "--size",  "96x54",         "--backend",
        backend,     "--check", "--plugin-path", builtExample("depth_of_field"),
        "--effects", effects,   "--write",       "color=a.exr"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = runProgram(words, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return image::read(folder_ / "a.exr");
  }
  static float largest(const image::Image& one, const image::Image& other) {
    float most = 0;
    for (size_t i = 0; i < one.pixels.size(); ++i) {
      most = std::max(most, std::abs(one.pixels[i] - other.pixels[i]));
    }
    return most;
  }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, DepthOfField, ::testing::Values("opengl", "vulkan"),
                         [](const auto& of) { return of.param; });

// With an aperture of 0 the effect hands on what it reads: the picture of the effects before it.
// The layers of effects behind it lie over its colour.
TEST_P(DepthOfField, GetsThePictureOfTheEffectsBeforeItAndHandsItOn) {
  const std::string none = "depth_of_field.aperture=0";
  for (const std::string surface : {"white", "base"}) {
    const image::Image plain = render("ssao", {"--surface", surface});
    for (const char* effects : {"ssao,depth_of_field", "depth_of_field,ssao"}) {
      const image::Image handed = render(effects, {"--surface", surface, "--set", none});
      EXPECT_LE(largest(plain, handed), 0.001f) << surface << ", " << effects;
    }
  }
}

// A white picture without sky has nothing to blur.
TEST_P(DepthOfField, BlursOnlyWhatIsBeforeIt) {
  const std::vector<std::string> down = {
      "--camera", R"({"eye": [-6.5, 1.75, 1.9], "target": [-2.6, 0.2, -0.5], "fovy_degrees": 40})",
      "--set"};
  std::vector<std::string> wide = down, none = down;
  wide.emplace_back("depth_of_field.aperture=0.5");
  none.emplace_back("depth_of_field.aperture=0");
  const image::Image sharp = render("ssao,depth_of_field", none);
  EXPECT_GT(largest(render("ssao,depth_of_field", wide), sharp), 0.1f);
  EXPECT_LE(largest(render("depth_of_field,ssao", wide), sharp), 0.001f);
}

TEST_P(DepthOfField, BackendsAgree) {
  if (GetParam() != "vulkan") GTEST_SKIP() << "the run on vulkan compares both backends";
  const std::vector<std::string> more = {"--surface", "base", "--set",
                                         "depth_of_field.aperture=0.3"};
  const image::Image one = render("ssao,depth_of_field", more);
  const image::Image other = render("ssao,depth_of_field", more, "opengl");
  EXPECT_LT(image::shareOver(one, other, 0.02), 0.002);
}

}  // namespace
}  // namespace grisaille::tests
