// SPDX-License-Identifier: MIT
// The example with two passes, half resolution and a history that follows motion vectors.
#include <cmath>

#include "tests/examples/example_host.h"

namespace grisaille::tests {
namespace {

// A ball on a floor before a wall, lit from behind.
class ContactShadowsHost : public ExampleHost {
 protected:
  void SetUp() override {
    GRISAILLE_NEEDS_INSTALLATION();
    start("contact_shadows");
    seen_ = see(eye_, kWidth, kHeight);
    depth_ = numbers([&](double x, double y) { return seen_.view[index(x, y)]; });
    facets_ = host_->texture(*device_, Texels::kFloat4, kWidth, kHeight, normals());
    resting_ = colours([](double, double) { return 0; });
  }
  static size_t index(double x, double y) {
    return static_cast<size_t>(y) * kWidth + static_cast<size_t>(x);
  }

  host::Effect shadows(double frames = 1) {
    host::Effect effect = this->effect();
    effect.set("azimuth", kAzimuth);
    effect.set("elevation", kElevation);
    effect.set("length", kLength);
    effect.set("thickness", 1.0);
    effect.set("steps", 64.0);
    effect.set("strength", 1.0);
    effect.set("frames", frames);
    return effect;
  }
  std::vector<float> shade(host::Effect& effect,
                           std::span<const grisaille_host_input> inputs = {}) {
    return record(effect, {.camera = camera_,
                           .depth = depth_,
                           .normal = &facets_,
                           .motion = &resting_,
                           .inputs = inputs});
  }
  // Distance along the ray from the pixel's surface to the light at which it hits something; below
  // 0 for surfaces that do not face the light.
  double hitAt(size_t pixel) const {
    const glm::dmat4 world = glm::inverse(eye_.viewFromWorld);
    const glm::dvec3 place(world * glm::dvec4(placeOf(eye_, seen_, pixel), 1));
    const glm::dvec3 light(std::cos(kElevation) * std::cos(kAzimuth), std::sin(kElevation),
                           std::cos(kElevation) * std::sin(kAzimuth));
    if (glm::dot(light, seen_.normal[pixel]) <= 0.2) return -1;
    return meet(place + 0.01 * seen_.normal[pixel], light).along;
  }

  static constexpr double kAzimuth = -2.2, kElevation = 0.7, kLength = 0.6;
  const Eye eye_ = {.viewFromWorld = glm::lookAt(glm::dvec3(-0.6, 1.4, 2.6),
                                                 glm::dvec3(0.1, 0.3, 0), glm::dvec3(0, 1, 0)),
                    .angle = 0.7};
  const glm::dmat4 projection_ = projectionOf(eye_, double{kWidth} / kHeight, {.near = 0.1});
  const host::Camera camera_{&eye_.viewFromWorld[0][0], &projection_[0][0]};
  Seen seen_;
  host::Texture depth_, facets_, resting_;

 private:
  std::vector<float> normals() const {
    std::vector<float> all;
    for (const glm::dvec3& normal : seen_.normal) {
      for (int i = 0; i < 3; ++i) all.push_back(static_cast<float>(normal[i]));
      all.push_back(0);
    }
    return all;
  }
};
GRISAILLE_IN_EVERY_HOST(ContactShadowsHost);

// Where rays say so clearly: nothing within the reach, or a hit in its first half.
TEST_P(ContactShadowsHost, AgreeWithRays) {
  host::Effect effect = shadows();
  const std::vector<float> drawn = shade(effect);
  int lit = 0, dark = 0, wrong = 0;
  for (size_t i = 0; i < drawn.size(); ++i) {
    if (seen_.view[i] == 0) continue;
    const double hit = hitAt(i);
    if (hit < 0) continue;
    if (hit > 1.1 * kLength) {
      ++lit;
      if (drawn[i] < 0.5) ++wrong;
    } else if (hit < 0.5 * kLength) {
      ++dark;
      if (drawn[i] > 0.5) ++wrong;
    }
  }
  std::printf("%d lit, %d dark, %d wrong\n", lit, dark, wrong);
  EXPECT_GT(lit, 1000);
  EXPECT_GT(dark, 200);
  // The camera does not see the far side of the ball, and edges are half as fine.
  EXPECT_LT(wrong, (lit + dark) / 12);
}

TEST_P(ContactShadowsHost, TheHistoryMakesSteadierShadows) {
  const auto change = [&](double frames) {
    host::Effect effect = shadows(frames);
    effect.set("steps", 4.0);
    std::vector<float> before;
    for (int i = 0; i < 11; ++i) before = shade(effect);
    const std::vector<float> now = shade(effect);
    double sum = 0;
    for (size_t i = 0; i < now.size(); ++i) sum += std::abs(now[i] - before[i]);
    return sum / static_cast<double>(now.size());
  };
  const double alone = change(1), averaged = change(8);
  std::printf("change from frame to frame %.4f, with a history %.4f\n", alone, averaged);
  EXPECT_LT(averaged, 0.35 * alone);
}

// The picture is multiplied by both.
TEST_P(ContactShadowsHost, OfShadowAndAmbientOcclusionTheDarkerCounts) {
  host::Effect alone = shadows(), with = shadows();
  const auto half = [](double x, double y) { return 0.2 + 0.6 * std::fmod(x + y, 2); };
  const host::Texture ao = numbers(half);
  const grisaille_host_input inputs[] = {host::inputOf("ssao.ao", ao)};
  const std::vector<float> shadow = shade(alone), less = shade(with, inputs);
  for (size_t i = 0; i < shadow.size(); ++i) {
    const double open = half(static_cast<double>(i % kWidth) + 0.5,
                             static_cast<double>(i / kWidth) + 0.5);  // of whole numbers
    EXPECT_NEAR(less[i] * open, std::min<double>(shadow[i], open), 0.002) << i;
  }
}

class ContactShadows : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { GRISAILLE_NEEDS_INSTALLATION(); }
};
INSTANTIATE_TEST_SUITE_P(, ContactShadows, ::testing::Values("opengl", "vulkan"),
                         [](const auto& of) { return of.param; });

// `ssao.ao` reaches the effect only if ssao runs before it.
TEST_P(ContactShadows, ReadAnEffectThatRunsBeforeThem) {
  const TemporaryFolder folder;
  const auto draw = [&](const std::string& effects) {
    const Outcome outcome =
        runProgram({"render", "--size", "96x54", "--backend", GetParam(), "--check",
                    "--plugin-path", builtExample("contact_shadows"), "--effects", effects,
                    "--write", "shadow=shadow.exr", "--write", "color=color.exr"},
                   folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return image::read(folder / "shadow.exr");
  };
  const image::Image alone = draw("contact_shadows");
  EXPECT_EQ(draw("contact_shadows,ssao").pixels, alone.pixels);
  const image::Image behind = draw("ssao,contact_shadows");
  size_t lighter = 0;
  for (size_t i = 0; i < alone.pixels.size(); ++i) {
    EXPECT_GE(behind.pixels[i], alone.pixels[i] - 0.001f) << i;
    if (behind.pixels[i] > alone.pixels[i] + 0.01f) ++lighter;
  }
  EXPECT_GT(lighter, 100u);
}

}  // namespace
}  // namespace grisaille::tests
