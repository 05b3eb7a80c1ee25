// SPDX-License-Identifier: MIT
// A truth traced in the background: exact at the end, honest estimates before, stopped at any time.
#include "app/truth/live_truth.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <thread>

#include "app/truth/comparison.h"
#include "app/truth/occlusion_truth.h"
#include "tests/support/animated_gltf.h"
#include "tests/support/folder_test.h"

namespace grisaille::app::truth {
namespace {

class LiveTruthTest : public tests::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  }

  LiveView view(glm::uvec2 size, uint32_t samples) const {
    return {.scene = atrium_,
            .camera = scene::atriumCamera(),
            .size = size,
            .radius = 0.7,
            .samples = samples};
  }

  // Passes every update to `seen`, until the last.
  template <typename Seen>
  static void follow(LiveTruth& live, const Seen& seen) {
    Traced traced;
    while (!traced.done) {
      if (live.poll(traced)) {
        seen(traced);
      } else {
        ASSERT_TRUE(live.running());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    EXPECT_FALSE(live.poll(traced));
    while (live.running()) std::this_thread::yield();
  }

  // Expects the values that the tracer gives in one call.
  static void expectExact(const Traced& traced, const LiveView& view) {
    const trace::RayTracer tracer(*view.scene, view.camera.eye);
    const auto hits = tracer.castPrimary(view.camera, view.size.x, view.size.y);
    const auto values = tracer.ambientOcclusion(hits, view.radius, view.samples, kSeed);
    ASSERT_EQ(traced.values.size(), values.size());
    EXPECT_EQ(traced.size, view.size);
    EXPECT_EQ(traced.pixels, values.size());
    EXPECT_EQ(traced.rays, view.samples);
    size_t different = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      const auto same = [](float a, float b) {
        return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
      };
      const trace::Visibility &a = traced.values[i], &b = values[i];
      if (!same(a.mean, b.mean) || !same(a.standardError, b.standardError)) ++different;
    }
    EXPECT_EQ(different, 0u);
  }

  const std::shared_ptr<const scene::Scene> atrium_ =
      std::make_shared<const scene::Scene>(scene::makeAtrium());
};

TEST_F(LiveTruthTest, IsTheTracersOwnInTheEnd) {
  for (const auto& [size, samples] :
       {std::pair(glm::uvec2(61, 37), 80u), {glm::uvec2(1, 1), 16u}, {glm::uvec2(90, 40), 7u}}) {
    LiveTruth live;
    const LiveView wanted = view(size, samples);
    live.start(wanted);
    Traced last;
    follow(live, [&](const Traced& traced) { last = traced; });
    expectExact(last, wanted);
  }
}

// Estimates from part of the pixels with few rays hold for the whole.
TEST_F(LiveTruthTest, EveryEstimateIsHonest) {
  const LiveView wanted = view({96, 72}, 1024);
  image::Image shown{.width = 96, .height = 72, .channels = 1, .pixels = {}};
  for (uint32_t i = 0; i < 96 * 72; ++i) {
    shown.pixels.push_back(0.6f + 0.3f * std::sin(static_cast<float>(i) * 0.003f));
  }
  LiveTruth live;
  live.start(wanted);
  std::vector<Comparison> all;
  double share = 0, rays = 0;
  follow(live, [&](const Traced& traced) {
    all.push_back(compare(shown, traced.values));
    const double now = static_cast<double>(traced.pixels) / static_cast<double>(96 * 72);
    EXPECT_GE(now, share);
    EXPECT_GE(traced.rays, rays);
    share = now;
    rays = traced.rays;
  });
  EXPECT_EQ(share, 1);
  EXPECT_EQ(rays, 1024);
  const Comparison& last = all.back();
  EXPECT_GT(last.rmse, 0.05);
  EXPECT_LT(last.error, 1e-4);
  for (const Comparison& one : all) EXPECT_NEAR(one.rmse, last.rmse, 5 * one.error + 1e-6);
  EXPECT_GT(all.front().error, 3 * last.error) << "the first update came late";
}

TEST_F(LiveTruthTest, IsStartedAnewAndEndedAtAnyTime) {
  const auto other = std::make_shared<const scene::Scene>(*atrium_);
  std::mt19937 engine(3);
  const auto below = [&](uint32_t end) {
    return std::uniform_int_distribution<uint32_t>(0, end - 1)(engine);
  };
  LiveTruth live;
  Traced traced;
  for (int i = 0; i < 300; ++i) {
    LiveView wanted = view({1 + below(200), 1 + below(200)}, 16 + below(100));
    if (below(4) == 0) wanted.scene = other;
    wanted.radius = 0.1 + 0.01 * below(100);
    wanted.camera.eye.x += 0.01 * below(100);
    live.start(wanted);
    if (below(3) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(below(8)));
    if (live.poll(traced)) {
      // Never the result of an earlier request.
      ASSERT_EQ(traced.size, wanted.size);
      ASSERT_EQ(traced.values.size(), size_t{wanted.size.x} * wanted.size.y);
    }
    if (below(5) != 0) continue;
    live.cancel();
    EXPECT_FALSE(live.running());
    EXPECT_FALSE(live.poll(traced));
  }
  live.cancel();
  const LiveView wanted = view({50, 30}, 40);
  live.start(wanted);
  follow(live, [&](const Traced& now) { traced = now; });
  // The tracer may belong to another scene or origin: equally good, but not bitwise equal.
  EXPECT_EQ(traced.rays, 40);
  for (int i = 0; i < 20; ++i) {
    LiveTruth ended;
    ended.start(view({300, 200}, 64));
    std::this_thread::sleep_for(std::chrono::milliseconds(below(4)));
  }
}

TEST_F(LiveTruthTest, TakesUpWhatWasKept) {
  const LiveView wanted = view({64, 36}, 16);
  const OcclusionTruth kept = traceOcclusion(*wanted.scene, wanted.camera, wanted.size,
                                             wanted.radius, 128, ProgressStyle::kNone);
  LiveTruth live;
  live.start(wanted);
  Traced last;
  follow(live, [&](const Traced& traced) { last = traced; });
  EXPECT_EQ(last.rays, 128);
  for (size_t i = 0; i < last.values.size(); ++i) {
    const float a = last.values[i].mean, b = kept.visibility.pixels[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
  }
}

// The owner poses the scene while the thread traces: each truth is that of its view's pose.
TEST_F(LiveTruthTest, TracesThePoseOfItsView) {
  const auto shown =
      std::make_shared<scene::Scene>(scene::loadGltf(fileOf("a.glb", tests::animatedGlb())));
  LiveView wanted = view({40, 30}, 32);
  wanted.scene = shown;
  wanted.camera = scene::defaultCamera(*shown, 4.0 / 3);
  LiveTruth live;
  Traced last;
  for (const double seconds : {0.0, 1.0, 1.5}) {
    wanted.pose = {.animation = 0, .seconds = seconds};
    scene::pose(*shown, wanted.pose);
    live.start(wanted);
    scene::pose(*shown, {.animation = 1, .seconds = 0.6});
    follow(live, [&](const Traced& traced) { last = traced; });
    scene::Scene posed = *shown;
    scene::pose(posed, wanted.pose);
    LiveView expected = wanted;
    expected.scene = std::make_shared<scene::Scene>(posed);
    expectExact(last, expected);
  }
}

TEST_F(LiveTruthTest, SaysWhyItCannot) {
  scene::Scene broken = *atrium_;
  for (scene::Material& material : broken.materials) {
    material.masked = true;
    material.baseColorTexture = static_cast<int>(broken.textures.size());  // none
  }
  LiveView wanted = view({20, 20}, 16);
  wanted.scene = std::make_shared<const scene::Scene>(broken);
  LiveTruth live;
  live.start(wanted);
  while (live.running()) std::this_thread::yield();
  Traced traced;
  EXPECT_THROW(live.poll(traced), std::out_of_range);
  EXPECT_FALSE(live.poll(traced));
  // It continues with another scene.
  live.start(view({20, 20}, 16));
  follow(live, [&](const Traced& now) { traced = now; });
  EXPECT_EQ(traced.pixels, 400u);
}

}  // namespace
}  // namespace grisaille::app::truth
