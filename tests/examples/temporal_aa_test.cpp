// SPDX-License-Identifier: MIT
// The example with jitter, motion and a history of the colour.
#include <cmath>

#include "tests/examples/example_host.h"

namespace grisaille::tests {
namespace {

// A wall of stripes that moves across a camera at rest.
class TemporalAaHost : public ExampleHost {
 protected:
  void SetUp() override {
    GRISAILLE_NEEDS_INSTALLATION();
    start("temporal_aa");
    wall_ = numbers([](double, double) { return 3; });
  }
  static double stripes(double x) { return 0.5 + 0.4 * std::sin(x * 0.7); }

  // Root of the mean square of the difference to the stripes, moved so many pixels to the right.
  static double errorOf(const std::vector<float>& texels, double moved) {
    double sum = 0;
    for (uint32_t x = 24; x < kWidth - 24; ++x) {
      const double wanted = stripes(x + 0.5 - moved);
      const double off = texels[4 * (size_t{kHeight} / 2 * kWidth + x)] - wanted;
      sum += off * off;
    }
    return std::sqrt(sum / (kWidth - 48));
  }
  // Renders some frames of stripes that move `step` pixels in each, with noise of this size, and
  // returns the error of the last one. `told`: the motion vectors say so.
  double errorAfter(double step, double noise, bool told, int frames = 12) {
    host::Effect effect = this->effect();
    effect.set("width", 4.0);
    double error = 0;
    for (int i = 0; i < frames; ++i) {
      uint32_t state = 12345u + 977u * static_cast<uint32_t>(i);
      const host::Texture colour = colours([&](double x, double) {
        state = state * 1664525u + 1013904223u;
        return stripes(x - i * step) + noise * (state * 0x1p-31 - 1);
      });
      const host::Texture motion = colours([&](double, double) { return told ? -step : 0; });
      error = errorOf(record(effect, {.camera = camera_,
                                      .depth = wall_,
                                      .colour = &colour,
                                      .motion = &motion,
                                      .motionScale = {1, 0}}),
                      i * step);
    }
    return error;
  }

  const glm::dmat4 view_ = glm::dmat4(1);
  const glm::dmat4 projection_ =
      projectionOf({.angle = 0.9}, double{kWidth} / kHeight, {.near = 0.1});
  const host::Camera camera_{&view_[0][0], &projection_[0][0]};
  host::Texture wall_;
};
GRISAILLE_IN_EVERY_HOST(TemporalAaHost);

TEST_P(TemporalAaHost, TheHistoryFollowsTheMotionVectors) {
  const double followed = errorAfter(1.37, 0.1, true), ignored = errorAfter(1.37, 0.1, false);
  std::printf("error with motion %.4f, without %.4f\n", followed, ignored);
  EXPECT_LT(followed, 0.5 * ignored);
  EXPECT_LT(followed, 0.03);
}

TEST_P(TemporalAaHost, FramesAreAveraged) {
  const double first = errorAfter(0, 0.1, true, 1), last = errorAfter(0, 0.1, true);
  std::printf("error of the first frame %.4f, of the twelfth %.4f\n", first, last);
  EXPECT_LT(last, 0.6 * first);
}

TEST_P(TemporalAaHost, AReactiveMaskForgetsTheHistory) {
  const host::Texture none = colours([](double, double) { return 0; });
  const auto last = [&](int frames, double mask) {
    host::Effect effect = this->effect();
    effect.set("width", 16.0);
    const host::Texture reactive = numbers([&](double, double) { return mask; });
    const grisaille_host_input inputs[] = {host::inputOf("reactive", reactive)};
    std::vector<float> texels;
    for (int i = frames; i-- > 0;) {
      const host::Texture colour = colours([&](double x, double) { return stripes(x + 2 * i); });
      texels = record(effect, {.camera = camera_,
                               .depth = wall_,
                               .colour = &colour,
                               .motion = &none,
                               .inputs = inputs});
    }
    return texels;
  };
  const std::vector<float> alone = last(1, 1);
  EXPECT_EQ(last(4, 1), alone);
  EXPECT_NE(last(4, 0), alone);
}

TEST_P(TemporalAaHost, WithoutMotionTheErrorNamesIt) {
  host::Effect effect = this->effect();
  const host::Texture colour = colours([](double, double) { return 1; });
  expectLacks(effect, {.camera = camera_, .depth = wall_, .colour = &colour},
              "temporal_aa needs frame.motion");
}

class TemporalAa : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { GRISAILLE_NEEDS_INSTALLATION(); }
  image::Image render(const std::string& size, const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "render",  "--size",     size,   "--backend",     GetParam(),
        "--check", "--surface",  "base", "--plugin-path", builtExample("temporal_aa"),
        "--write", "color=a.exr"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = runProgram(words, folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return image::read(folder_ / "a.exr");
  }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, TemporalAa, ::testing::Values("opengl", "vulkan"),
                         [](const auto& of) { return of.param; });

// Against 8 x 8 samples a pixel.
TEST_P(TemporalAa, APictureAtRestComesNearToASupersampledOne) {
  constexpr uint32_t kAcross = 96, kDown = 54, kMore = 8;
  const image::Image fine = render("768x432", {"--effects", "sspm"});
  const auto error = [&](const image::Image& image) {
    double sum = 0;
    for (uint32_t y = 0; y < kDown; ++y) {
      for (uint32_t x = 0; x < kAcross; ++x) {
        double mean = 0;
        for (uint32_t i = 0; i < kMore * kMore; ++i) {
          mean += fine.at(x * kMore + i % kMore, y * kMore + i / kMore, 1) / (kMore * kMore);
        }
        sum += (image.at(x, y, 1) - mean) * (image.at(x, y, 1) - mean);
      }
    }
    return std::sqrt(sum / (kAcross * kDown));
  };
  const double plain = error(render("96x54", {"--effects", "sspm"}));
  const double smooth = error(render("96x54", {"--effects", "temporal_aa", "--frames", "32"}));
  std::printf("error without the effect %.4f, with it %.4f\n", plain, smooth);
  EXPECT_LT(smooth, 0.6 * plain);
}

TEST_P(TemporalAa, PicturesWithoutMotionAreAnErrorThatNamesIt) {
  render("96x54", {"--effects", "ssao", "--write", "depth=depth.exr"});
  const Outcome outcome = runProgram(
      {"apply", "--depth", "depth.exr", "--backend", GetParam(), "--plugin-path",
       builtExample("temporal_aa"), "--effects", "ssao,temporal_aa", "--write", "color=b.exr"},
      folder_.path());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err.rfind("error E3208: temporal_aa needs motion, which nothing gives it", 0),
            0u)
      << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
