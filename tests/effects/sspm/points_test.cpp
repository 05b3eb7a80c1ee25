// SPDX-License-Identifier: MIT
// Paint at points of surfaces: against the picture, against closed forms, and against the
// definition with rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>

#include "core/gpu/null_device.h"
#include "core/scene/built_in.h"
#include "lab/oracle/paint.h"
#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

constexpr double kAll = std::numbers::pi;  // the steepest surface of all

// Places shots and draws at points, without a picture: no device is needed.
class Score {
 public:
  explicit Score(const scene::Scene& scene)
      : rays_(scene), device_(gpu::makeNullDevice()), frame_(*device_, scene) {
    frame_.setRays(&rays_);
  }

  PaintFrame& frame() { return frame_; }
  const trace::RayTracer& tracer() const { return rays_.tracer(); }

  void place(std::span<const lab::Shot> shots) {
    frame_.render(kCrease, 16, 16, shots, {"paint"});
    EXPECT_EQ(frame_.waiting(), 0u);
  }

  // Share of the surface that the shots of each green hold; the other channels tell nothing.
  std::map<float, double> shares(std::span<const lab::Shot> shots, double steepest = kAll,
                                 uint32_t count = 100'000) {
    const trace::SurfacePoints surface = sample(count, steepest);
    std::map<float, double> sums;
    for (const grisaille_drawn& drawn : frame_.drawAt(surface.points)) {
      if (drawn.owner == 0) continue;
      sums[shots[drawn.owner - 1].color[1]] +=
          double{drawn.alpha} / static_cast<double>(surface.points.size());
    }
    return sums;
  }
  trace::SurfacePoints sample(uint32_t count, double steepest = kAll, uint32_t seed = 0) const {
    return tracer().surfacePoints({.count = count, .steepest = steepest, .seed = seed});
  }

 private:
  TracedRays rays_;
  std::unique_ptr<gpu::Device> device_;
  PaintFrame frame_;
};

lab::Shot greenAt(const glm::dvec3& origin, const glm::dvec3& target, float green,
                  float range = 0) {
  return shotAt(origin, target, glm::vec3(0, green, 0), range);
}

// Hard rims: a disc is a disc.
const Settings kHard = {{"edge_fade", "0"}, {"splat_sharpness", "1"}};

TEST(PointsTest, ADiscOnABareWall) {
  const scene::Scene scene = wallScene(8, 4);
  Score score(scene);
  score.frame().set(kHard);
  const std::vector<lab::Shot> shots = {greenAt({0.5, 0.3, 2}, {0.5, 0.3, 0}, 1, 1)};
  score.place(shots);
  EXPECT_NEAR(score.shares(shots)[1], std::numbers::pi / 32, 0.0005);
}

// Two discs of radius 1 whose centres are 1 apart: the newer one keeps all of its area.
TEST(PointsTest, TheNewerOfTwoColours) {
  const scene::Scene scene = wallScene(8, 4);
  Score score(scene);
  score.frame().set(kHard);
  const std::vector<lab::Shot> shots = {greenAt({0, 0, 2}, {0, 0, 0}, 0.5f, 1),
                                        greenAt({1, 0, 2}, {1, 0, 0}, 1, 1)};
  score.place(shots);
  const double lens = 2 * std::acos(0.5) - 0.5 * std::sqrt(3);
  auto shares = score.shares(shots);
  EXPECT_NEAR(shares[1], std::numbers::pi / 32, 0.0005);
  EXPECT_NEAR(shares[0.5f], (std::numbers::pi - lens) / 32, 0.0005);
}

// The floor behind the edge of a wall is out of the muzzle's sight, and the slope leaves the wall
// out.
TEST(PointsTest, TheSlopeLeavesWallsOut) {
  const scene::Scene scene = cornerScene(8);
  Score score(scene);
  score.frame().set(kHard);
  const std::vector<lab::Shot> shots = {greenAt({2, 2, 2}, {2, 0, 2}, 1, 1),
                                        greenAt({-2, 2, 2}, {-2, 2, 0}, 0.5f, 1)};
  score.place(shots);
  auto all = score.shares(shots), floors = score.shares(shots, 0.7);
  EXPECT_NEAR(all[1], std::numbers::pi / 96, 0.0005);
  EXPECT_NEAR(all[0.5f], std::numbers::pi / 96, 0.0005);
  EXPECT_NEAR(floors[1], std::numbers::pi / 64, 0.0005);
  EXPECT_EQ(floors.count(0.5f), 0u);
}

// Behind a wall there is no paint, though the point lies in the shot's range.
TEST(PointsTest, PaintStopsAtTheFirstSurface) {
  scene::Scene scene = wallScene(4, 4);
  const uint32_t behind = static_cast<uint32_t>(scene.instances.size());
  scene.instances.push_back(scene.instances[0]);
  scene.instances[behind].worldFromObject[3] = glm::dvec4(0, 0, -0.2, 1);
  scene::computeBounds(scene);
  Score score(scene);
  score.frame().set(kHard);
  const std::vector<lab::Shot> shots = {greenAt({0, 0, 2}, {0, 0, 0}, 1, 1)};
  score.place(shots);
  EXPECT_NEAR(score.shares(shots)[1], std::numbers::pi / 32, 0.0005);
  Settings through = kHard;
  through.emplace_back("mode", "per_shot");
  score.frame().set(through);
  EXPECT_NEAR(score.shares(shots)[1], std::numbers::pi / 16, 0.0005);
}

TEST(PointsTest, FarFromTheOriginNothingChanges) {
  std::vector<std::map<float, double>> shares;
  for (const double far : {0.0, 3e6}) {
    const glm::dvec3 offset(far, -far / 2, far / 3);
    scene::Scene scene = cornerScene(6);
    for (scene::Instance& instance : scene.instances) {
      instance.worldFromObject[3] += glm::dvec4(offset, 0);
    }
    scene::computeBounds(scene);
    Score score(scene);
    score.frame().set({{"edge_fade", "1"}});
    std::vector<lab::Shot> shots;
    for (int i = 0; i < 20; ++i) {
      shots.push_back(greenAt(offset + glm::dvec3(0.2 * i - 2, 1.5, 2),
                              offset + glm::dvec3(0.2 * i - 2, i % 3 * 0.4, i % 3 == 0 ? 0.5 : 0),
                              i % 2 == 0 ? 1 : 0.5f, 0.4f));
    }
    score.place(shots);
    shares.push_back(score.shares(shots));
  }
  ASSERT_EQ(shares[0].size(), 2u);
  for (const auto& [green, share] : shares[0]) {
    EXPECT_GT(share, 0.01);
    // The splats are others.
    EXPECT_NEAR(shares[1][green], share, 0.004) << green;
  }
}

// A shot that waits, because the host cannot tell, or that is given up is not in the score.
TEST(PointsTest, ShotsThatAreNotDrawnDoNotCount) {
  class Blind : public effect::RayService {
   public:
    void cast(std::span<const grisaille_ray> /*rays*/, std::span<grisaille_hit> hits) override {
      std::ranges::fill(hits, grisaille_hit{GRISAILLE_HIT_UNKNOWN, 0, {}});
    }
  } blind;
  const scene::Scene scene = wallScene(4, 4);
  Score score(scene);
  score.frame().set(kHard);
  score.frame().setRays(&blind);
  std::vector<lab::Shot> shots = {greenAt({0, 0, 2}, {0, 0, 0}, 1, 1)};
  score.frame().render(kCrease, 16, 16, shots, {"paint"});
  EXPECT_EQ(score.frame().waiting(), 1u);
  EXPECT_TRUE(score.shares(shots).empty());
}

// A shot that an undo removes takes its paint along before the next frame, and what it hid waits
// for that frame.
TEST(PointsTest, TheListOfNowCounts) {
  const scene::Scene scene = wallScene(8, 4);
  Score score(scene);
  score.frame().set(kHard);
  std::vector<lab::Shot> shots = {greenAt({-2, 0, 2}, {-2, 0, 0}, 0.5f, 1),
                                  greenAt({2, 0, 2}, {2, 0, 0}, 1, 1)};
  score.place(shots);
  score.frame().assign(std::span(shots).first(1));
  auto shares = score.shares(shots);
  EXPECT_NEAR(shares[0.5f], std::numbers::pi / 32, 0.0005);
  EXPECT_EQ(shares.count(1), 0u);
  score.place(shots);
  EXPECT_NEAR(score.shares(shots)[1], std::numbers::pi / 32, 0.0005);
}

// The definition in double precision at one point, with a segment traced to every muzzle.
double referenceAt(const trace::RayTracer& tracer, const glm::dvec3& position,
                   const glm::dvec3& normal, std::span<const lab::oracle::PaintLayer> shots,
                   const lab::oracle::PaintSettings& settings, float& green) {
  const auto sighted = [&](const lab::Shot& shot) {
    return sees(tracer, {shot.origin[0], shot.origin[1], shot.origin[2]}, position, normal);
  };
  const auto pixel = lab::oracle::paintOf(position, 1, 1e-9, shots, settings,
                                          lab::oracle::Sight{.facet = normal, .sees = sighted});
  green = static_cast<float>(pixel.paint.y);
  return pixel.paint.w;
}

// Places on the scene's triangles, by area, at random.
std::vector<std::pair<glm::dvec3, glm::dvec3>> randomPlaces(const scene::Scene& scene,
                                                            size_t count) {
  struct One {
    glm::dvec3 corner, a, b;
    bool twoSided;
  };
  std::vector<One> triangles;
  std::vector<double> areas;
  for (const scene::Instance& instance : scene.instances) {
    const scene::Primitive& primitive = scene.primitives[instance.primitive];
    const bool twoSided = scene.materials[primitive.material].doubleSided;
    for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
      glm::dvec3 c[3];
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t vertex = scene.indices[primitive.firstIndex + i + k];
        c[k] = glm::dvec3(instance.worldFromObject * glm::dvec4(scene.positions[vertex], 1));
      }
      if (glm::determinant(glm::dmat3(instance.worldFromObject)) < 0) std::swap(c[1], c[2]);
      triangles.push_back({c[0], c[1] - c[0], c[2] - c[0], twoSided});
      areas.push_back(glm::length(glm::cross(triangles.back().a, triangles.back().b)) *
                      (twoSided ? 2 : 1));
    }
  }
  std::mt19937 random(99);
  std::discrete_distribution<size_t> which(areas.begin(), areas.end());
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::pair<glm::dvec3, glm::dvec3>> places;
  while (places.size() < count) {
    const One& t = triangles[which(random)];
    double u = unit(random), v = unit(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    glm::dvec3 normal = glm::normalize(glm::cross(t.a, t.b));
    if (t.twoSided && unit(random) < 0.5) normal = -normal;
    places.emplace_back(t.corner + u * t.a + v * t.b, normal);
  }
  return places;
}

// 200 shots in two colours at anything that the cameras see.
std::vector<lab::Shot> battle(const trace::RayTracer& tracer,
                              std::span<const scene::Camera> cameras, float range) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  while (shots.size() < 200) {
    const scene::Camera& camera = cameras[shots.size() % cameras.size()];
    const std::vector<glm::uvec2> pixel = {glm::uvec2(640 * unit(random), 360 * unit(random))};
    const trace::Hit hit = tracer.castPrimary(camera, 640, 360, pixel)[0];
    const glm::dvec3 muzzle = camera.eye + glm::dvec3(unit(random), unit(random), unit(random));
    if (hit.viewDepth == 0 || glm::length(hit.position - muzzle) < 0.5) continue;
    shots.push_back(greenAt(muzzle, hit.position, unit(random) < 0.5 ? 0.5f : 1, range));
  }
  return shots;
}

// Shares against 100,000 random places. A short ray to a place tells whether it is a hole.
void expectReference(const scene::Scene& scene, std::span<const scene::Camera> cameras) {
  Score score(scene);
  const std::vector<lab::Shot> shots = battle(score.tracer(), cameras, 1.5f);
  score.place(shots);
  auto shares = score.shares(shots);
  std::map<float, double> reference;
  size_t counted = 0;
  const auto layers = lab::oracle::layersOf(shots, {}, false);
  for (const auto& [position, normal] : randomPlaces(scene, 100'000)) {
    const glm::dvec3 start = position + 1e-4 * normal;
    const grisaille_ray down = {
        .origin = {start.x, start.y, start.z},
        .direction = {static_cast<float>(-normal.x), static_cast<float>(-normal.y),
                      static_cast<float>(-normal.z)},
        .reach = 2e-4f};
    grisaille_hit hit = {};
    score.tracer().castRays({&down, 1}, {&hit, 1});
    if (hit.kind == GRISAILLE_HIT_NONE) continue;  // a hole
    ++counted;
    float green = 0;
    const double alpha = referenceAt(score.tracer(), position, normal, layers, {}, green);
    if (alpha > 0) reference[green > 0.75f ? 1 : 0.5f] += alpha;
  }
  for (const float green : {0.5f, 1.0f}) {
    const double truth = reference[green] / static_cast<double>(counted);
    std::printf("%s: share %.4f, by rays %.4f\n", scene.name.c_str(), shares[green], truth);
    EXPECT_GT(truth, 0.01);
    EXPECT_NEAR(shares[green], truth, 0.01);
  }
}

TEST(PointsTest, TheAtriumAgreesWithRays) {
  const scene::Scene scene = scene::makeAtrium();
  expectReference(scene, std::vector{scene::defaultCamera(scene, 16.0 / 9)});
}

TEST(PointsTest, SponzaAgreesWithRays) {
  const std::filesystem::path shared = SHARED_FOLDER;
  if (!std::filesystem::exists(shared / "scenes/Sponza.glb")) GTEST_SKIP() << "Sponza is missing";
  std::vector<scene::Camera> cameras;
  for (const char* name : {"atrium", "arcade", "gallery", "lion"}) {
    cameras.push_back(scene::loadCamera(shared / "cameras" / (std::string(name) + ".json")));
  }
  expectReference(scene::loadGltf(shared / "scenes/Sponza.glb"), cameras);
}

// Hiding leaves shots out of lists and counts twins: every point is that of the definition.
TEST(PointsTest, HidingChangesNothing) {
  const scene::Scene scene = cornerScene(4);
  Score score(scene);
  for (uint32_t seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<lab::Shot> shots;
    for (int i = 0; i < 600; ++i) {
      if (i % 4 == 3) {
        shots.push_back(shots.back());  // twins
        shots.back().color[1] = static_cast<float>(unit(random));
        continue;
      }
      const glm::dvec3 origin(2 * unit(random) - 1, 0.4 + unit(random), 0.4 + unit(random));
      const double along = 0.6 * unit(random);
      const bool floor = i % 2 == 0;
      const glm::dvec3 target(0.6 * unit(random) - 0.3, floor ? 0 : along, floor ? along : 0);
      shots.push_back(greenAt(origin, target, static_cast<float>(unit(random))));
    }
    const lab::oracle::PaintSettings settings = {.paintRange = 0.1 + 0.2 * unit(random),
                                                 .full = seed % 2 == 0 ? 1 : 0.05,
                                                 .edgeFade = seed < 2 ? 0.5 : 0};
    score.frame().set({{"paint_range", fmt::format("{}", settings.paintRange)},
                       {"r0", fmt::format("{}", settings.full)},
                       {"edge_fade", fmt::format("{}", settings.edgeFade)}});
    score.place(shots);
    std::vector<grisaille_point> points;
    for (const grisaille_point& point : score.sample(200'000).points) {
      const auto near = [](double x) { return std::abs(x) < 0.8; };
      if (std::ranges::all_of(point.position, near)) points.push_back(point);
    }
    ASSERT_GT(points.size(), 2000u);
    const std::vector<grisaille_drawn> drawn = score.frame().drawAt(points);
    const auto layers = lab::oracle::layersOf(shots, settings, false);
    size_t wrong = 0, painted = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      const double* p = points[i].position;
      const float* n = points[i].normal;
      float green = 0;
      const double alpha = referenceAt(score.tracer(), {p[0], p[1], p[2]}, {n[0], n[1], n[2]},
                                       layers, settings, green);
      painted += alpha > 0 ? 1 : 0;
      const bool right = std::abs(double{drawn[i].alpha} - alpha) < 2.0 / 255 &&
                         std::abs(drawn[i].colour[1] - green) < 2.0f / 255;
      wrong += right ? 0 : 1;
    }
    EXPECT_GT(painted, 500u);
    EXPECT_LE(wrong, painted / 200) << "seed " << seed << ", " << painted << " painted";
  }
}

class PointsPictureTest : public BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(PointsPictureTest);

// The points of the pixels' centres have what the picture shows there.
TEST_P(PointsPictureTest, PointsAreThePicture) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  const std::vector<trace::Hit> hits = rays.tracer().castPrimary(kCrease, kWidth, kHeight);
  std::vector<grisaille_point> points;
  for (const trace::Hit& hit : hits) {
    const glm::dvec3& p = hit.position;
    const glm::vec3 n(hit.viewDepth > 0 ? hit.facetNormal : glm::dvec3(0, 1, 0));
    points.push_back({.position = {p.x, p.y, p.z}, .normal = {n.x, n.y, n.z}, .reserved = 0});
  }
  frame::PictureAttachments places(&device());
  places.show(tracedPictures(rays.tracer(), kCrease, kWidth, kHeight));
  PaintFrame frame(device(), places);
  frame.setRays(&rays);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  for (int i = 0; i < 80; ++i) {
    const glm::dvec3 origin(2 * unit(random) - 1, 0.4 + unit(random), 0.4 + unit(random));
    const glm::dvec3 target(2 * unit(random) - 1, i % 2 == 0 ? 0 : unit(random), 0.01);
    shots.push_back(shotAt(origin, target, randomColor(random), i % 5 == 0 ? 0.6f : 0));
  }
  for (const char* mode : {"surface", "per_shot"}) {
    // Cells of 30 cm are wider than four pixels: no octave fades.
    frame.set({{"mode", mode},
               {"shot_limit", "70"},
               {"splat_scale", "1.2"},
               {"splat_sharpness", "0.5"},
               {"noise_seed", "7"}});
    frame.render(kCrease, kWidth, kHeight, shots, {"paint", "paint_owner"});
    const image::Image paint = frame.read("paint"), owner = frame.read("paint_owner");
    const std::vector<grisaille_drawn> drawn = frame.drawAt(points);
    size_t wrong = 0, painted = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].viewDepth == 0) continue;
      const uint32_t x = hits[i].pixel.x, y = hits[i].pixel.y;
      const float alpha = paint.at(x, y, 3);
      bool right = std::abs(alpha - drawn[i].alpha) < 3.0f / 255;
      if (alpha > 0.02f) {
        ++painted;
        for (uint32_t c = 0; c < 3; ++c) {
          right = right && std::abs(paint.at(x, y, c) - drawn[i].colour[c]) < 3.0f / 255;
        }
        right = right && owner.at(x, y) == static_cast<float>(drawn[i].owner);
      }
      wrong += right ? 0 : 1;
    }
    EXPECT_GT(painted, 1000u);
    EXPECT_LE(wrong, painted / 100) << mode << ", " << painted << " painted";
  }
}

}  // namespace
}  // namespace grisaille::tests
