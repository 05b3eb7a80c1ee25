// SPDX-License-Identifier: MIT
// Paint in `surface` mode, compared with the ray-traced mask: in range, with a free segment to the
// muzzle.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "lab/paint/paint_mask.h"
#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kMaskWidth = 1280;
constexpr uint32_t kMaskHeight = 720;
constexpr size_t kAlone = 48;  // shots of a scene, one by one

using Mask = std::vector<uint8_t>;

struct Agreement {
  size_t traced = 0, both = 0, either = 0;
  size_t stray = 0;  // covered pixels more than 2 px from the mask
  void add(bool truth, bool painted) {
    traced += truth ? 1 : 0;
    both += truth && painted ? 1 : 0;
    either += truth || painted ? 1 : 0;
  }
  void add(const Agreement& other) {
    traced += other.traced;
    both += other.both;
    either += other.either;
    stray += other.stray;
  }
  double iou() const {
    return either > 0 ? static_cast<double>(both) / static_cast<double>(either) : 1;
  }
};

Agreement compare(const Mask& mask, const image::Image& coverage) {
  Agreement result;
  const uint32_t width = coverage.width, height = coverage.height;
  const auto traced = [&](uint32_t x, uint32_t y) { return mask[size_t{y} * width + x] != 0; };
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const bool truth = traced(x, y);
      const bool painted = coverage.at(x, y) > 0;
      result.add(truth, painted);
      if (!painted || truth) continue;
      bool near = false;
      for (uint32_t v = y - std::min(y, 2u); v <= std::min(y + 2, height - 1); ++v) {
        for (uint32_t u = x - std::min(x, 2u); u <= std::min(x + 2, width - 1); ++u) {
          near = near || traced(u, v);
        }
      }
      result.stray += near ? 0 : 1;
    }
  }
  return result;
}

// Paint of the shots, compared with their mask at `hits`, those of the camera's pixels.
Agreement shoot(PaintFrame& frame, const trace::RayTracer& tracer, const scene::Camera& camera,
                std::span<const trace::Hit> hits, std::span<const lab::Shot> shots) {
  frame.render(camera, kMaskWidth, kMaskHeight, shots, {"paint_coverage"});
  return compare(lab::paintMask(tracer, hits, shots, 0), frame.read("paint_coverage"));
}

// At any pixel of the picture, from anywhere up to 1.5 `around` from the camera, with a range of
// `least` to `most`; lengths in metres. None if the pixel shows no surface.
std::optional<lab::Shot> anyShot(std::mt19937& random, const scene::Camera& camera,
                                 std::span<const trace::Hit> hits, double least, double most,
                                 double around = 1) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto x = static_cast<uint32_t>(kMaskWidth * (0.05 + 0.9 * unit(random)));
  const auto y = static_cast<uint32_t>(kMaskHeight * (0.05 + 0.9 * unit(random)));
  const trace::Hit& target = hits[y * kMaskWidth + x];
  const glm::dvec3 muzzle =
      camera.eye +
      around * glm::dvec3(3 * unit(random) - 1.5, 1.5 * unit(random) - 0.7, 3 * unit(random) - 1.5);
  if (target.viewDepth == 0) return {};
  const double range = least + (most - least) * unit(random);
  return shotAt(muzzle, target.position, glm::vec3(1, 0, 0), static_cast<float>(range));
}

// A square bar between two places; thickness: half of its width, metres.
void addBar(scene::Scene& scene, const glm::dvec3& from, const glm::dvec3& to, double thickness) {
  const glm::dvec3 along = (to - from) / 2.0;
  const glm::dvec3 side = thickness * glm::normalize(glm::cross(along, glm::dvec3(0.1, 1, 0.2)));
  const glm::dvec3 up = thickness * glm::normalize(glm::cross(side, along));
  addBox(scene, glm::dmat4(glm::dvec4(side, 0), glm::dvec4(up, 0), glm::dvec4(along, 0),
                           glm::dvec4((from + to) / 2.0, 1)));
}

class MaskTest : public BackendTest {
 protected:
  struct Scenery {
    const char* name;
    std::vector<const char*> cameras;
    double range;  // metres
    double leastIou;
    double leastGood;  // share of the shots
  };
  void expectMasks(bool byDepths);
  void expectAlone(const Scenery& scenery);
  void expectMask(const scene::Scene& scene, const scene::Camera& camera, const lab::Shot& shot);
};
GRISAILLE_ON_EVERY_DEVICE(MaskTest);

// byDepths: the host tells by depth pictures, not by rays, what a muzzle sees.
void MaskTest::expectMasks(bool byDepths) {
  const std::filesystem::path shared = SHARED_FOLDER;
  if (!std::filesystem::exists(shared / "scenes/Sponza.glb")) GTEST_SKIP() << "Sponza is missing";
  const scene::Scene scene = scene::loadGltf(shared / "scenes/Sponza.glb");
  TracedRays rays(scene);
  TracedDepths depths(rays.tracer());
  std::mt19937 random(11);
  Agreement sum;
  size_t shotCount = 0;
  for (const char* name : {"atrium", "arcade", "gallery", "lion"}) {
    const scene::Camera camera =
        scene::loadCamera(shared / "cameras" / (std::string(name) + ".json"));
    const std::vector<trace::Hit> hits = rays.tracer().castPrimary(camera, kMaskWidth, kMaskHeight);
    PaintFrame frame(device(), scene);
    if (byDepths) {
      frame.setDepths(&depths);
    } else {
      frame.setRays(&rays);
    }
    for (int i = 0; i < 8; ++i) {
      const std::optional<lab::Shot> shot = anyShot(random, camera, hits, 0.1, 0.5);
      if (!shot) continue;
      const auto shots = std::span(&*shot, 1);
      frame.set({{"edge_fade", "0"}});
      const Agreement one = shoot(frame, rays.tracer(), camera, hits, shots);
      SCOPED_TRACE(
          fmt::format("{}, shot {} with range {}: {} px", name, i, shot->range, one.traced));
      // Smaller masks are mostly edge.
      if (one.traced >= 500) {
        EXPECT_GE(one.iou(), 0.97);
      }
      ++shotCount;
      sum.add(one);
    }
  }
  std::printf(
      "%s: %zu px, intersection over union %.4f, %zu px astray, %zu rays and %zu pictures "
      "a shot\n",
      GetParam().label.c_str(), sum.traced, sum.iou(), sum.stray, rays.count() / shotCount,
      depths.count() / shotCount);
  EXPECT_GE(sum.iou(), 0.995);
  EXPECT_LE(rays.count(), 3000 * shotCount);
  // Paint may stray at edges thinner than the finest squares of a map.
  EXPECT_LE(sum.stray, sum.both / 50000);
}

TEST_P(MaskTest, PaintLandsWhereTheMuzzleSees) {
  expectMasks(false);
}

TEST_P(MaskTest, PaintLandsWhereADepthPictureOfTheMuzzleShowsASurface) {
  expectMasks(true);
}

// Compares a single shot.
void MaskTest::expectMask(const scene::Scene& scene, const scene::Camera& camera,
                          const lab::Shot& shot) {
  TracedRays rays(scene);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  frame.set({{"edge_fade", "0"}});
  const auto shots = std::span(&shot, 1);
  const std::vector<trace::Hit> hits = rays.tracer().castPrimary(camera, kMaskWidth, kMaskHeight);
  const Agreement one = shoot(frame, rays.tracer(), camera, hits, shots);
  EXPECT_GT(one.traced, 4000);
  EXPECT_GE(one.iou(), 0.97) << one.both << " of " << one.traced;
}

// Fires shots one by one, with ranges of a fifth of the scene's range to all of it. A shot is good
// if its intersection over union is at least 0.97; masks under 50 pixels are nearly all edge.
void MaskTest::expectAlone(const Scenery& scenery) {
  const std::filesystem::path shared = SHARED_FOLDER;
  const std::filesystem::path file = shared / "scenes" / (std::string(scenery.name) + ".glb");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
  const scene::Scene scene = scene::loadGltf(file);
  TracedRays rays(scene);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  frame.set({{"edge_fade", "0"}});
  std::mt19937 random(13);
  Agreement sum;
  size_t shotCount = 0, counted = 0, good = 0;
  double worst = 1;
  for (const char* view : scenery.cameras) {
    const scene::Camera camera =
        scene::loadCamera(shared / "cameras" / (std::string(view) + ".json"));
    const std::vector<trace::Hit> hits = rays.tracer().castPrimary(camera, kMaskWidth, kMaskHeight);
    for (const size_t end = shotCount + kAlone / scenery.cameras.size(); shotCount < end;) {
      const double range = scenery.range;
      const auto shot = anyShot(random, camera, hits, range / 5, range, 4 * range);
      if (!shot) continue;
      ++shotCount;
      const auto shots = std::span(&*shot, 1);
      const Agreement one = shoot(frame, rays.tracer(), camera, hits, shots);
      sum.add(one);
      if (one.traced < 50) continue;
      ++counted;
      good += one.iou() >= 0.97 ? 1 : 0;
      worst = std::min(worst, one.iou());
    }
  }
  std::printf(
      "%s, %s: %zu px, intersection over union %.4f; of %zu shots %zu good, the worst %.2f; %zu "
      "rays a shot\n",
      GetParam().label.c_str(), scenery.name, sum.traced, sum.iou(), counted, good, worst,
      rays.count() / shotCount);
  EXPECT_GE(counted, kAlone / 2);
  EXPECT_GE(sum.iou(), scenery.leastIou);
  EXPECT_GE(static_cast<double>(good), scenery.leastGood * static_cast<double>(counted));
}

// Ranges as the program chooses them, but for Sponza the table's default. The trees' leaves are
// finer than a map's squares.
TEST_P(MaskTest, ShotsAloneInScenesOfAllSizes) {
  for (const Scenery& scenery : {
           Scenery{"Sponza", {"atrium", "arcade", "gallery", "lion"}, 0.25, 0.995, 0.93},
           Scenery{"room", {"room_table", "room_sofa"}, 0.1, 0.995, 0.93},
           Scenery{"trees", {"trees_fence", "trees_crown"}, 0.3, 0.88, 0.25},
           Scenery{"machine", {"machine_stand", "machine_grate"}, 0.1, 0.985, 0.9},
           Scenery{"street", {"street_walk", "street_roofs"}, 0.6, 0.99, 0.9},
           Scenery{"chess", {"chess_board", "chess_low"}, 0.015, 0.985, 0.9},
           Scenery{"knight", {"knight_full", "knight_bust"}, 0.075, 0.995, 0.93},
       }) {
    SCOPED_TRACE(scenery.name);
    expectAlone(scenery);
  }
}

// Many shots in one picture, of which the newest wins everywhere.
TEST_P(MaskTest, AThousandAndTenThousandShotsTogether) {
  const std::filesystem::path shared = SHARED_FOLDER;
  if (!std::filesystem::exists(shared / "scenes/Sponza.glb")) GTEST_SKIP() << "Sponza is missing";
  const scene::Scene scene = scene::loadGltf(shared / "scenes/Sponza.glb");
  TracedRays rays(scene);
  const scene::Camera camera = scene::loadCamera(shared / "cameras/atrium.json");
  const std::vector<trace::Hit> hits = rays.tracer().castPrimary(camera, kMaskWidth, kMaskHeight);
  std::mt19937 random(12);
  std::vector<lab::Shot> shots;
  while (shots.size() < 10'000) {
    if (const auto shot = anyShot(random, camera, hits, 0.05, 0.25)) shots.push_back(*shot);
  }
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  // With the defaults, two shots mix where the newer one is thin.
  frame.set({{"edge_fade", "0"}, {"splat_sharpness", "1"}});
  for (const size_t count : {1000u, 10'000u}) {
    const auto some = std::span(shots).first(count);
    frame.render(camera, kMaskWidth, kMaskHeight, some, {"paint_owner"});
    const image::Image painted = frame.read("paint_owner");
    const std::vector<uint32_t> traced = lab::paintOwners(rays.tracer(), hits, some, 0);
    Agreement paint;
    size_t newest = 0;
    for (size_t i = 0; i < traced.size(); ++i) {
      const auto owner = static_cast<uint32_t>(painted.pixels[i]);
      paint.add(traced[i] != 0, owner != 0);
      newest += owner != 0 && owner == traced[i] ? 1 : 0;
    }
    const double right = static_cast<double>(newest) / static_cast<double>(paint.either);
    std::printf("%s: %zu shots, %zu px, intersection over union %.4f, right shot on %.4f\n",
                GetParam().label.c_str(), count, paint.traced, paint.iou(), right);
    EXPECT_GT(paint.traced, size_t{kMaskWidth} * kMaskHeight / 2);
    EXPECT_GE(paint.iou(), 0.995);
    EXPECT_GE(right, 0.98);
  }
}

// A bar that is thin beside a map's coarse squares, and runs past the muzzle.
TEST_P(MaskTest, PaintGoesAlongABarBesideTheMuzzle) {
  scene::Scene scene = wallScene();
  addBar(scene, {0, 0.05, 0.5}, {0.06, 0.14, 1.85}, 0.004);
  expectMask(scene, {.eye = glm::dvec3(-0.6, 0.3, 1.5), .target = glm::dvec3(0.1, 0.03, 1.3)},
             shotAt({0, 0, 2}, {0, 0, 0}, glm::vec3(1, 0, 0), 0.2f));
}

// A screen close to the muzzle has a gap, through which the shot paints bars on the wall.
TEST_P(MaskTest, PaintIsAsFineBehindAGap) {
  scene::Scene scene = wallScene();
  for (const auto& [from, to] : {std::pair(-1.0f, 0.02f), std::pair(0.05f, 1.0f)}) {
    addQuad(scene, {glm::vec3(from, -1, 1.7), {to, -1, 1.7}, {to, 1, 1.7}, {from, 1, 1.7}},
            {0, 0, 1});
  }
  for (int i = 0; i < 5; ++i) {
    const double x = 0.1 + 0.05 * i;
    addBar(scene, {x, -0.4, 0.05}, {x, 0.4, 0.05}, 0.01);
  }
  expectMask(scene, {.eye = glm::dvec3(0.2, 0.1, 0.7), .target = glm::dvec3(0.15, 0, 0)},
             shotAt({0, 0, 2}, {0, 0, 0}, glm::vec3(1, 0, 0), 0.2f));
}

// The picture shows what lies behind such a wall, and so do depth pictures of the muzzle.
TEST_P(MaskTest, ShotsPassAWallWhoseBackIsNotDrawn) {
  const scene::Scene open = cornerScene();
  scene::Scene walled = cornerScene();
  addQuad(walled, {glm::vec3(9, 0, 1.5f), {-9, 0, 1.5f}, {-9, 9, 1.5f}, {9, 9, 1.5f}}, {0, 0, -1});
  scene::computeBounds(walled);
  const std::vector<lab::Shot> shots = {
      shotAt({0.2, 1.2, 2.4}, {0.1, 0.5, 0}, glm::vec3(1, 0, 0), 0.4f)};
  const auto coverage = [&](const scene::Scene& scene, bool byDepths, const char* mode) {
    TracedRays rays(scene);
    TracedDepths depths(rays.tracer());
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    if (byDepths) frame.setDepths(&depths);
    frame.set({{"edge_fade", "0"}, {"mode", mode}});
    frame.render(kCrease, kWidth, kHeight, shots, {"paint_coverage"});
    return frame.read("paint_coverage").pixels;
  };
  for (const char* mode : {"surface", "per_shot"}) {
    const auto expected = coverage(open, false, mode);
    EXPECT_GT(std::ranges::count_if(expected, [](float x) { return x > 0; }), 200) << mode;
    EXPECT_EQ(coverage(walled, false, mode), expected) << mode << " by rays";
    EXPECT_EQ(coverage(walled, true, mode), coverage(open, true, mode)) << mode << " by depths";
  }
}

// A muzzle at the camera sees what the camera sees. A speck is a pixel without paint whose eight
// neighbours are in the mask and have paint.
TEST_P(MaskTest, PaintOnLedgesAndColumnsHasNoSpecks) {
  const scene::Scene scene = scene::makeAtrium();
  TracedRays rays(scene);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  frame.set({{"edge_fade", "0"}});
  constexpr uint32_t kViewWidth = 960, kViewHeight = 540;
  constexpr double kRange = 1.2;
  const scene::Camera camera = scene.camera.value();
  const std::vector<trace::Hit> hits = rays.tracer().castPrimary(camera, kViewWidth, kViewHeight);
  struct Target {
    glm::uvec2 pixel;
    size_t most;  // specks
  };
  // A round column before a wall; the foot of a wall behind leaves, thinner than a map's squares.
  for (const auto& [pixel, most] :
       {Target{glm::uvec2(900, 330), 2}, Target{glm::uvec2(60, 350), 100}}) {
    const trace::Hit& target = hits[pixel.y * kViewWidth + pixel.x];
    const std::vector<lab::Shot> shots = {
        shotAt(camera.eye, target.position, glm::vec3(1, 0, 0), static_cast<float>(kRange))};
    frame.render(camera, kViewWidth, kViewHeight, shots, {"paint_coverage"});
    const image::Image coverage = frame.read("paint_coverage");
    const Mask mask = lab::paintMask(rays.tracer(), hits, shots, kRange);
    size_t specks = 0, painted = 0;
    for (uint32_t y = 1; y + 1 < kViewHeight; ++y) {
      for (uint32_t x = 1; x + 1 < kViewWidth; ++x) {
        if (mask[size_t{y} * kViewWidth + x] == 0) continue;
        painted += coverage.at(x, y) > 0 ? 1 : 0;
        bool isSpeck = coverage.at(x, y) == 0;
        for (uint32_t v = y - 1; v <= y + 1; ++v) {
          for (uint32_t u = x - 1; u <= x + 1; ++u) {
            if (u == x && v == y) continue;
            isSpeck = isSpeck && mask[size_t{v} * kViewWidth + u] != 0 && coverage.at(u, v) > 0;
          }
        }
        specks += isSpeck ? 1 : 0;
      }
    }
    std::printf("%s: %zu specks in %zu px\n", GetParam().label.c_str(), specks, painted);
    EXPECT_GT(painted, 10'000u);
    EXPECT_LE(specks, most) << "pixel " << pixel.x << "," << pixel.y;
  }
}

}  // namespace
}  // namespace grisaille::tests
