// SPDX-License-Identifier: MIT
// `grisaille render` as a whole, on every backend: pictures compared with a ray cast of the same
// scene, with the other backend, and with ray-traced truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/frame/renderer.h"
#include "core/image/image.h"
#include "core/trace/ray_tracer.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

constexpr const char* kCameras[] = {"atrium", "arcade", "gallery", "lion"};

// The backends with a device on this machine.
// Every `stride`-th pixel in both directions, away from the picture's border.
std::vector<glm::uvec2> somePixels(uint32_t width, uint32_t height, uint32_t stride) {
  std::vector<glm::uvec2> pixels;
  for (uint32_t y = stride / 2; y < height; y += stride) {
    for (uint32_t x = stride / 2; x < width; x += stride) pixels.emplace_back(x, y);
  }
  return pixels;
}

struct Agreement {
  double median = 0;   // relative error of depth
  double over1e3 = 0;  // share of pixels off by more than 1e-3, or sky on one side only
};

Agreement compareDepth(const image::Image& depth, const std::vector<trace::Hit>& truth) {
  std::vector<double> errors;
  for (const trace::Hit& hit : truth) {
    const double drawn = depth.at(hit.pixel.x, hit.pixel.y);
    if (hit.viewDepth == 0 || drawn == 0) {
      errors.push_back(hit.viewDepth == drawn ? 0 : 1);
    } else {
      errors.push_back(std::abs(drawn / hit.viewDepth - 1));
    }
  }
  Agreement agreement;
  agreement.over1e3 =
      static_cast<double>(
          std::count_if(errors.begin(), errors.end(), [](double error) { return error > 1e-3; })) /
      static_cast<double>(errors.size());
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  agreement.median = errors[errors.size() / 2];
  return agreement;
}

struct Pictures {
  image::Image ao, depth, normal, color;
};

// Renders with --check: any message of the layer, the driver or its validation fails the run.
Pictures render(const std::string& backend, std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.begin(), "render");
  for (const char* more :
       {"--backend", backend.c_str(), "--check", "--effects", "ssao", "--write", "ao=a.exr",
        "--write", "depth=d.exr", "--write", "normal=n.exr", "--write", "color=c.png"}) {
    arguments.emplace_back(more);
  }
  const Outcome outcome = runProgram(arguments, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  if (outcome.status != 0) return {};
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"a.exr", "c.png", "d.exr", "n.exr"}));
  return {.ao = image::read(folder / "a.exr"),
          .depth = image::read(folder / "d.exr"),
          .normal = image::read(folder / "n.exr"),
          .color = image::read(folder / "c.png")};
}

void expectWholePictures(const Pictures& pictures) {
  for (const float value : pictures.ao.pixels) {
    ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 1) << value;
  }
  for (const float value : pictures.depth.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0);
  // White light on white surfaces, before a grey background: sRGB encoded in the PNG.
  for (uint32_t y = 0; y < pictures.ao.height; y += 7) {
    for (uint32_t x = 0; x < pictures.ao.width; x += 7) {
      const bool sky = pictures.depth.at(x, y) == 0;
      const float v = sky ? frame::kGrey.r : pictures.ao.at(x, y);
      const double code =
          v <= 0.0031308f ? v * 12.92 : 1.055 * std::pow(static_cast<double>(v), 1 / 2.4) - 0.055;
      for (uint32_t c = 0; c < 3; ++c) ASSERT_NEAR(pictures.color.at(x, y, c), code, 1.1 / 255);
    }
  }
}

// Along a plane, 1 / depth is linear in the pixel position. A bend means that two surfaces meet.
bool bends(const image::Image& depth, uint32_t x, uint32_t y) {
  const double here = 1 / depth.at(x, y);
  const auto bent = [&](float before, float after) {
    return !(std::abs((1 / before + 1 / after) / (2 * here) - 1) < 3e-6);
  };
  return bent(depth.at(x - 1, y), depth.at(x + 1, y)) ||
         bent(depth.at(x, y - 1), depth.at(x, y + 1));
}

// Whether two surfaces meet within two pixels, in either picture.
bool nearEdge(const image::Image& a, const image::Image& b, uint32_t x, uint32_t y) {
  for (uint32_t v = y - 2; v <= y + 2; ++v) {
    for (uint32_t u = x - 2; u <= x + 2; ++u) {
      if (bends(a, u, v) || bends(b, u, v)) return true;
    }
  }
  return false;
}

void expectBackendsAgree(const std::vector<Pictures>& all) {
  for (size_t i = 1; i < all.size(); ++i) {
    EXPECT_LT(image::shareOver(all[0].ao, all[i].ao, 2.0 / 255), 0.001);
    const image::Image &a = all[0].depth, &b = all[i].depth;
    uint64_t off = 0, atEdges = 0;
    for (uint32_t y = 3; y + 3 < a.height; ++y) {
      for (uint32_t x = 3; x + 3 < a.width; ++x) {
        if (a.at(x, y) == b.at(x, y) || std::abs(b.at(x, y) / a.at(x, y) - 1) < 1e-5f) continue;
        ++(nearEdge(a, b, x, y) ? atEdges : off);
      }
    }
    EXPECT_EQ(off, 0u);
    EXPECT_LT(atEdges, uint64_t{a.width} * a.height / 100);
  }
}

TEST(Render, BuiltInSceneAgreesWithARayCastOnEveryBackend) {
  const scene::Scene scene = scene::makeAtrium();
  const scene::Camera camera = scene::atriumCamera();
  const trace::RayTracer tracer(scene, camera.eye);
  std::vector<Pictures> all;
  for (const std::string& backend : backends()) {
    SCOPED_TRACE(backend);
    all.push_back(render(backend, {"--size", "640x360"}));
    if (HasFailure()) return;
    expectWholePictures(all.back());
    const std::vector<glm::uvec2> pixels = somePixels(640, 360, 2);
    const std::vector<trace::Hit> truth = tracer.castPrimary(camera, 640, 360, pixels);
    const Agreement agreement = compareDepth(all.back().depth, truth);
    EXPECT_LT(agreement.median, 1e-5);
    EXPECT_LT(agreement.over1e3, 0.01);
    uint64_t turned = 0, sky = 0;
    for (const trace::Hit& hit : truth) {
      if (hit.viewDepth == 0) {
        ++sky;
        continue;
      }
      const glm::uvec2 p = hit.pixel;
      const image::Image& n = all.back().normal;
      const glm::vec3 drawn(n.at(p.x, p.y, 0), n.at(p.x, p.y, 1), n.at(p.x, p.y, 2));
      if (glm::dot(drawn, hit.normal) < 0.99f) ++turned;
    }
    EXPECT_LT(static_cast<double>(turned) / static_cast<double>(truth.size()), 0.01);
    EXPECT_GT(sky, 0u) << "the built-in camera should see the sky";
  }
  ASSERT_FALSE(all.empty()) << "no backend runs here";
  expectBackendsAgree(all);
}

class Sponza : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, Sponza, ::testing::ValuesIn(kCameras),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(Sponza, AgreesWithARayCastAndTheOtherBackend) {
  if (sponza().empty()) GTEST_SKIP() << kNoSponza;
  const scene::Scene scene = scene::loadGltf(sponza());
  const scene::Camera camera = scene::loadCamera(sponzaCamera(GetParam()));
  const trace::RayTracer tracer(scene, camera.eye);
  std::vector<Pictures> all;
  for (const std::string& backend : backends()) {
    SCOPED_TRACE(backend);
    all.push_back(render(
        backend, {sponza(), "--camera", sponzaCamera(GetParam()), "--set", "ssao.radius=0.5"}));
    if (HasFailure()) return;
    expectWholePictures(all.back());
    const std::vector<trace::Hit> truth =
        tracer.castPrimary(camera, 1280, 720, somePixels(1280, 720, 3));
    const Agreement agreement = compareDepth(all.back().depth, truth);
    EXPECT_LT(agreement.median, 1e-5);
    EXPECT_LT(agreement.over1e3, 0.01);
    RecordProperty(backend + " depth median", std::to_string(agreement.median));
  }
  expectBackendsAgree(all);
}

// The truth is the share of cosine-weighted rays that travel half a metre. The defaults must be no
// worse than the best-known tutorial with 64 taps: 0.117 on this view.
TEST(SponzaTruth, DefaultsAreNoWorseThanTheTutorial) {
  if (sponza().empty()) GTEST_SKIP() << kNoSponza;
  constexpr uint32_t kSamples = 256;
  const scene::Scene scene = scene::loadGltf(sponza());
  std::map<std::string, double> sums;
  for (const char* name : kCameras) {
    const scene::Camera camera = scene::loadCamera(sponzaCamera(name));
    const trace::RayTracer tracer(scene, camera.eye);
    const auto hits = tracer.castPrimary(camera, 1280, 720, somePixels(1280, 720, 10));
    const auto truth = tracer.ambientOcclusion(hits, 0.5, kSamples, 1);
    for (const std::string& backend : backends()) {
      const image::Image ao =
          render(backend, {sponza(), "--camera", sponzaCamera(name), "--set", "ssao.radius=0.5"})
              .ao;
      if (HasFailure()) return;
      double squares = 0;
      size_t count = 0;
      for (size_t i = 0; i < hits.size(); ++i) {
        if (std::isnan(truth[i].mean)) continue;
        const double off = ao.at(hits[i].pixel.x, hits[i].pixel.y) - truth[i].mean;
        squares += off * off;
        ++count;
      }
      sums[backend] += std::sqrt(squares / static_cast<double>(count));
    }
  }
  EXPECT_FALSE(sums.empty()) << "no backend runs here";
  for (const auto& [backend, sum] : sums) {
    std::printf("%s: RMSE %.4f over four cameras\n", backend.c_str(), sum / 4);
    EXPECT_LE(sum / 4, 0.117) << backend;
  }
}

}  // namespace
}  // namespace grisaille::tests
