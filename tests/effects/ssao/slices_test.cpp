// SPDX-License-Identifier: MIT
// The slices estimator: requirements at every resolution, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <random>

#include "core/frame/view_block.h"
#include "tests/effects/ssao/render_ao.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

constexpr const char* kResolutions[] = {"full", "half", "quarter"};
const scene::Camera kCorner = {.eye = glm::dvec3(0, 1.2, 1.5), .target = glm::dvec3(0, 0, 0)};

class SlicesTest : public tests::BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(SlicesTest);

std::string join(const tests::Settings& settings) {
  std::string all;
  for (const auto& [key, value] : settings) all += key + "=" + value + " ";
  return all;
}

TEST_P(SlicesTest, APlaneIsOpenAtEveryTiltAndDistance) {
  // A sheet too, which is its own back.
  scene::Scene scene = tests::floorScene(1e5f);
  scene.materials[0].doubleSided = true;
  for (const double degrees : {1.0, 10.0, 35.0, 60.0, 90.0}) {
    for (const double distance : {0.2, 2.0, 50.0, 1000.0}) {
      const double tilt = glm::radians(degrees);
      // Slightly turned, to avoid axes shared by the picture and the plane.
      const scene::Camera camera = {
          .eye = distance * glm::dvec3(0.1 * std::cos(tilt), std::sin(tilt), std::cos(tilt)),
          .target = glm::dvec3(0),
          .up = glm::normalize(glm::dvec3(0.3, std::cos(tilt), -std::sin(tilt)))};
      const auto expectOpen = [&](const tests::Settings& settings) {
        const image::Image ao = tests::renderAo(device(), scene, camera, settings);
        const float least = *std::min_element(ao.pixels.begin(), ao.pixels.end());
        EXPECT_GT(least, 0.98f) << join(settings) << degrees << " degrees, " << distance;
      };
      for (const char* resolution : kResolutions) expectOpen({{"resolution", resolution}});
      expectOpen({{"backs", "drawn"}, {"thickness", "1"}});
      expectOpen({{"backs", "peeled"}, {"thickness", "1"}});
    }
  }
}

// Visibility of a point on one wall of a right-angled corner, at a distance from the other wall in
// radii. Cosine-weighted directions are uniform on a disc; the other wall blocks the segment beyond
// that distance.
double cornerVisibility(double distance) {
  const double c = std::min(distance, 1.0);
  return 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / glm::pi<double>();
}

// Mean error of the picture, by distance from the crease in fifths of a radius; on the floor and on
// the wall.
std::array<std::array<double, 5>, 2> cornerErrors(const image::Image& ao, const image::Image& depth,
                                                  const scene::Camera& camera = kCorner) {
  std::array<std::array<double, 5>, 2> sums = {}, counts = {};
  const glm::dmat3 axes = scene::worldFromView(camera);
  const double scale = std::tan(glm::radians(camera.fovyDegrees) / 2) * 2 / ao.height;
  for (uint32_t y = 0; y < ao.height; ++y) {
    for (uint32_t x = 0; x < ao.width; ++x) {
      const glm::dvec3 ray((x + 0.5 - ao.width * 0.5) * scale, (ao.height * 0.5 - y - 0.5) * scale,
                           -1);
      const glm::dvec3 at = camera.eye + axes * ray * double{depth.at(x, y)};
      const bool wall = at.y > at.z;
      const double distance = (wall ? at.y : at.z) / 0.5;
      if (distance >= 1 || distance < 0) continue;
      const auto bin = static_cast<size_t>(distance * 5);
      sums[wall][bin] += ao.at(x, y) - cornerVisibility(distance);
      counts[wall][bin] += 1;
    }
  }
  for (size_t w = 0; w < 2; ++w) {
    for (size_t bin = 0; bin < 5; ++bin) sums[w][bin] /= counts[w][bin];
  }
  return sums;
}

TEST_P(SlicesTest, ACornerIsWithinTwoHundredthsOfItsAnalyticValue) {
  const scene::Scene scene = tests::cornerScene();
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"depth"};
  renderer.render({.camera = kCorner, .width = 640, .height = 480, .outputs = outputs});
  const image::Image depth = renderer.read("depth");
  // The near plane cuts floor and wall: where vertices snap coarsely, their depth is inexact.
  const double allowed = snapping().isCoarse() ? 0.03 : 0.02;
  for (const tests::Settings& settings : std::vector<tests::Settings>{
           {{"resolution", "full"}},
           {{"resolution", "half"}},
           {{"resolution", "half"}, {"kernel_size", "8"}},
           {{"resolution", "quarter"}, {"blur_size", "20"}},
           {{"resolution", "full"}, {"slices", "4"}, {"kernel_size", "128"}}}) {
    const auto errors =
        cornerErrors(tests::renderAo(device(), scene, kCorner, settings, 640, 480), depth);
    for (size_t w = 0; w < 2; ++w) {
      for (size_t bin = 0; bin < 5; ++bin) {
        EXPECT_NEAR(errors[w][bin], 0, allowed)
            << join(settings) << (w == 0 ? "floor" : "wall") << " at " << bin << " fifths";
      }
    }
  }
}

// The picture's border cuts the floor 0.4 radii before the wall. The floor goes on beyond it.
TEST_P(SlicesTest, AFloorDarkensAWallFromBeyondTheBorder) {
  const scene::Scene scene = tests::cornerScene();
  const double down = std::atan(0.5 / 1.3) - glm::radians(30.0);
  const scene::Camera camera = {.eye = glm::dvec3(0, 0.5, 1.5),
                                .target = glm::dvec3(0, 0.5 - 1.5 * std::tan(down), 0),
                                .fovyDegrees = 60};
  frame::Renderer renderer(device(), scene);
  const std::vector<std::string> outputs = {"depth"};
  renderer.render({.camera = camera, .width = 640, .height = 480, .outputs = outputs});
  const image::Image depth = renderer.read("depth");
  // With few taps, fewer of them lie on what is left of the floor.
  for (const auto& [taps, allowed] : {std::pair("16", 0.11), {"22", 0.04}, {"48", 0.04}}) {
    const tests::Settings settings = {{"guard_band", "0"}, {"kernel_size", taps}};
    const auto errors =
        cornerErrors(tests::renderAo(device(), scene, camera, settings, 640, 480), depth, camera);
    for (size_t bin = 0; bin < 5; ++bin) {
      EXPECT_NEAR(errors[1][bin], 0, allowed) << taps << " taps, wall at " << bin << " fifths";
    }
  }
}

TEST_P(SlicesTest, ExtremesStayVisibilitiesAtEverySize) {
  const scene::Scene scene = tests::cornerScene();
  const std::vector<tests::Settings> extremes = {{{"slices", "64"}, {"kernel_size", "1"}},
                                                 {{"kernel_size", "4096"}},
                                                 {{"kernel_size", "7"}, {"slices", "2"}},
                                                 {{"radius", "1e-6"}},
                                                 {{"radius", "1e6"}},
                                                 {{"thickness", "0"}},
                                                 {{"thickness", "1e6"}},
                                                 {{"thickness", "1e6"}, {"radius", "1e6"}},
                                                 {{"backs", "drawn"}, {"thickness", "0"}},
                                                 {{"backs", "drawn"}, {"guard_band", "0.5"}},
                                                 {{"backs", "peeled"}, {"thickness", "0"}},
                                                 {{"backs", "peeled"}, {"guard_band", "0.5"}},
                                                 {{"blur_size", "0"}},
                                                 {{"blur_size", "3"}},
                                                 {{"blur_size", "20"}},
                                                 {{"bias", "0.1"}},
                                                 {{"bias", "1e6"}},
                                                 {{"intensity", "0"}},
                                                 {{"intensity", "10"}},
                                                 {{"power", "0.1"}},
                                                 {{"power", "10"}},
                                                 {{"guard_band", "1"}},
                                                 {{"seed", "65535"}}};
  for (const char* resolution : kResolutions) {
    for (tests::Settings settings : extremes) {
      settings.emplace_back("resolution", resolution);
      tests::expectVisibility(tests::renderAo(device(), scene, kCorner, settings, 33, 17),
                              join(settings));
    }
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {1u, 64u}, {3u, 3u}, {65u, 2u}, {257u, 129u}}) {
      tests::expectVisibility(
          tests::renderAo(device(), scene, kCorner, {{"resolution", resolution}}, width, height),
          fmt::format("{} {}x{}", resolution, width, height));
    }
  }
}

TEST_P(SlicesTest, SkyIsOpenAndDarkensNothing) {
  // A post in front of the sky: only the post itself could darken it.
  scene::Scene scene;
  scene.materials.push_back({.name = "white"});
  tests::addQuad(scene, {glm::vec3(-0.4f, -3, 0), {0.4f, -3, 0}, {0.4f, 3, 0}, {-0.4f, 3, 0}},
                 {0, 0, 1});
  const scene::Camera camera = {.eye = glm::dvec3(0.2, 0.1, 4), .target = glm::dvec3(0, 0, 0)};
  for (const char* resolution : kResolutions) {
    const image::Image ao = tests::renderAo(device(), scene, camera, {{"resolution", resolution}});
    EXPECT_GT(*std::min_element(ao.pixels.begin(), ao.pixels.end()), 0.98f) << resolution;
  }
}

TEST_P(SlicesTest, SomethingFarBeforeAWallLeavesNoHalo) {
  // Farther away than the radius and thinner than its thickness: classic samplers darken the wall
  // around it.
  scene::Scene scene = tests::wallScene();
  tests::addQuad(scene, {glm::vec3(-0.3f, -3, 2), {0.3f, -3, 2}, {0.3f, 3, 2}, {-0.3f, 3, 2}},
                 {0, 0, 1});
  const scene::Camera camera = {.eye = glm::dvec3(0, 0, 5), .target = glm::dvec3(0, 0, 0)};
  for (const char* resolution : kResolutions) {
    const image::Image ao = tests::renderAo(device(), scene, camera, {{"resolution", resolution}});
    EXPECT_GT(*std::min_element(ao.pixels.begin(), ao.pixels.end()), 0.98f) << resolution;
  }
}

TEST_P(SlicesTest, MoreThicknessIsDarker) {
  // A thin shelf in front of a wall, seen from below: the depth does not show what lies behind its
  // front edge.
  scene::Scene scene = tests::wallScene();
  tests::addQuad(scene, {glm::vec3(-3, 0, 0.3f), {3, 0, 0.3f}, {3, 0.05f, 0.3f}, {-3, 0.05f, 0.3f}},
                 {0, 0, 1});
  const scene::Camera camera = {.eye = glm::dvec3(0, -0.5, 3), .target = glm::dvec3(0, 0, 0)};
  const auto mean = [&](const char* thickness) {
    return tests::meanRows(tests::renderAo(device(), scene, camera, {{"thickness", thickness}}), 0,
                           tests::kAoHeight);
  };
  EXPECT_GT(mean("0.01"), mean("0.3"));
  EXPECT_GT(mean("0.3"), mean("2"));
}

// A board at some distance from a wall, seen from the front only. Its thickness is a guess unless
// the depth of its back is known.
TEST_P(SlicesTest, BackFacesSayHowThickABoardIs) {
  const scene::Camera camera = {.eye = glm::dvec3(0.4, 0.5, 3), .target = glm::dvec3(0, 0, 0)};
  const auto mean = [&](float deep, const char* thickness, const char* back) {
    scene::Scene scene = tests::wallScene();
    const float front = 0.45f, rear = front - deep;
    tests::addQuad(scene,
                   {glm::vec3(-3, 0, front), {3, 0, front}, {3, 0.1f, front}, {-3, 0.1f, front}},
                   {0, 0, 1});
    tests::addQuad(scene, {glm::vec3(-3, 0.1f, rear), {3, 0.1f, rear}, {3, 0, rear}, {-3, 0, rear}},
                   {0, 0, -1});
    const tests::Settings settings = {{"thickness", thickness}, {"backs", back}};
    return tests::meanRows(tests::renderAo(device(), scene, camera, settings), 0, tests::kAoHeight);
  };
  EXPECT_GT(mean(0.02f, "1", "drawn"), mean(0.02f, "1", "assumed") + 0.005);
  EXPECT_LT(mean(0.4f, "0.05", "drawn"), mean(0.4f, "0.05", "assumed") - 0.005);
}

// A board hides the wall of a corner above its foot. It hangs farther than the radius from the
// floor by the wall, whose visibility thus stays that of the corner.
TEST_P(SlicesTest, AWallBehindABoardDarkensTheFloorBeforeIt) {
  scene::Scene scene = tests::cornerScene();
  glm::dmat4 place(1);
  place[0].x = 5;
  place[1].y = 0.22;
  place[2].z = 0.02;
  place[3] = {0, 0.98, 0.9, 1};
  tests::addBox(scene, place);
  const auto floorError = [&](const char* backs) {
    tests::AoFrames frames(device(), scene,
                           {{"backs", backs},
                            {"thickness", "1"},
                            {"resolution", "full"},
                            {"slices", "4"},
                            {"kernel_size", "128"}});
    const auto shown = frames.showAll(kCorner, 320, 240, {"ao", "depth"});
    const auto errors = cornerErrors(shown[0], shown[1]);
    double sum = 0;
    for (const double error : errors[0]) sum += std::abs(error) / 5;
    return sum;
  };
  const double drawn = floorError("drawn"), peeled = floorError("peeled");
  EXPECT_GT(drawn, 0.05);
  EXPECT_LT(peeled, 0.03);
}

// A square sheet with the corners centre +- u +- v.
struct Leaf {
  glm::dvec3 centre, u, v, normal;
};

// Leaves in a layer over the floor, at random places and tilts.
std::vector<Leaf> leaves() {
  std::vector<Leaf> all;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 400; ++i) {
    Leaf leaf;
    leaf.centre = {1.5 * unit(random), 0.35 + 0.25 * unit(random), 1.5 * unit(random)};
    leaf.normal = glm::normalize(glm::dvec3(unit(random), 1.2, unit(random)));
    leaf.u = 0.05 * glm::normalize(glm::cross(leaf.normal, glm::dvec3(0, 0, 1)));
    leaf.v = glm::cross(leaf.normal, leaf.u);
    all.push_back(leaf);
  }
  return all;
}

// Whether a ray of unit direction meets a leaf within the radius.
bool meetsLeaf(const std::vector<Leaf>& leaves, const glm::dvec3& point, const glm::dvec3& ray,
               double radius) {
  return std::ranges::any_of(leaves, [&](const Leaf& leaf) {
    const double t = glm::dot(leaf.centre - point, leaf.normal) / glm::dot(ray, leaf.normal);
    if (!(t > 1e-4 && t < radius)) return false;
    const glm::dvec3 at = point + t * ray - leaf.centre;
    return std::max(std::abs(glm::dot(at, leaf.u)), std::abs(glm::dot(at, leaf.v))) <=
           glm::dot(leaf.u, leaf.u);
  });
}

// Most taps miss a leaf. Those that meet one stand for its neighbours too.
TEST_P(SlicesTest, LeavesDarkenAsMuchAsTheyShould) {
  scene::Scene scene = tests::floorScene();
  scene.materials.push_back({.name = "leaf", .doubleSided = true});
  const std::vector<Leaf> all = leaves();
  for (const Leaf& leaf : all) {
    const glm::vec3 c(leaf.centre), u(leaf.u), v(leaf.v);
    tests::addQuad(scene, {c - u + v, c + u + v, c + u - v, c - u - v}, glm::vec3(leaf.normal), 1);
  }
  const scene::Camera camera = {.eye = glm::dvec3(0.3, 1.6, 2.6), .target = glm::dvec3(0, 0.2, 0)};
  constexpr double kRadius = 0.4;
  tests::AoFrames frames(device(), scene,
                         {{"radius", "0.4"},
                          {"backs", "drawn"},
                          {"thickness", "1"},
                          {"kernel_size", "24"},
                          {"resolution", "full"}});
  const auto shown = frames.showAll(camera, 192, 144, {"ao", "depth", "facet_normal"});
  double squares = 0, sum = 0;
  int count = 0;
  for (uint32_t y = 3; y < 144; y += 8) {
    for (uint32_t x = 3; x < 192; x += 8) {
      if (shown[1].at(x, y) == 0) continue;
      const glm::dvec3 point = tests::surfaceAt(camera, shown[1], x, y);
      if (std::max(std::abs(point.x), std::abs(point.z)) > 1.2) continue;
      const float* n = &shown[2].pixels[(size_t{y} * 192 + x) * shown[2].channels];
      // Rays start above the surface: a driver's depth may place the point behind its own leaf.
      const glm::dvec3 normal = glm::normalize(glm::dvec3(n[0], n[1], n[2]));
      const double truth = tests::tracedVisibility(normal, 64, [&](const glm::dvec3& ray) {
        return meetsLeaf(all, point + 1e-3 * normal, ray, kRadius);
      });
      const double error = shown[0].at(x, y) - truth;
      squares += error * error;
      sum += error;
      ++count;
    }
  }
  ASSERT_GE(count, 100);
  EXPECT_LT(std::sqrt(squares / count), 0.2);
  EXPECT_LT(std::abs(sum / count), 0.1);
}

// With a guard band, a picture equals the middle of a larger one. The band is a multiple of the
// noise's period and of the grid of far taps.
TEST_P(SlicesTest, AGuardBandMakesItTheMiddleOfALargerPicture) {
  const scene::Scene scene = tests::cornerScene();
  constexpr uint32_t kSize = 160, kBand = 80;
  scene::Camera wide = kCorner;
  const double share = (kSize + 2.0 * kBand) / kSize;
  wide.fovyDegrees =
      glm::degrees(2 * std::atan(std::tan(glm::radians(kCorner.fovyDegrees) / 2) * share));
  for (const char* resolution : kResolutions) {
    const tests::Settings settings = {
        {"resolution", resolution}, {"blur_size", "0"}, {"refine", "nothing"}};
    const image::Image larger =
        tests::renderAo(device(), scene, wide, settings, kSize + 2 * kBand, kSize + 2 * kBand);
    image::Image middle = {.width = kSize, .height = kSize, .channels = 1, .pixels = {}};
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        middle.pixels.push_back(larger.at(x + kBand, y + kBand));
      }
    }
    tests::Settings guarded = settings;
    guarded.emplace_back("guard_band", "0.5");
    const image::Image own = tests::renderAo(device(), scene, kCorner, guarded, kSize, kSize);
    // Except for rounding, which moves taps that fall between two pixels.
    const double off = image::shareOver(own, middle, 2.0 / 255);
    EXPECT_LT(off, 0.02) << resolution;
    // Without the guard band, the pictures differ more.
    const image::Image bare = tests::renderAo(device(), scene, kCorner, settings, kSize, kSize);
    EXPECT_GT(image::shareOver(bare, middle, 2.0 / 255), 2 * off) << resolution;
  }
}

TEST_P(SlicesTest, OneSeedGivesTheSameBitsAndAnotherDoesNot) {
  const scene::Scene scene = tests::cornerScene();
  const image::Image first = tests::renderAo(device(), scene, kCorner, {{"seed", "7"}});
  EXPECT_EQ(first.pixels, tests::renderAo(device(), scene, kCorner, {{"seed", "7"}}).pixels);
  EXPECT_NE(first.pixels, tests::renderAo(device(), scene, kCorner, {{"seed", "8"}}).pixels);
}

TEST_P(SlicesTest, TheDenoiserRemovesThePattern) {
  const scene::Scene scene = tests::cornerScene();
  const auto roughness = [&](const char* resolution, const char* blur) {
    const image::Image ao = tests::renderAo(
        device(), scene, kCorner, {{"resolution", resolution}, {"blur_size", blur}}, 320, 240);
    double sum = 0;
    for (uint32_t x = 1; x < 320; ++x) sum += std::abs(ao.at(x, 140) - ao.at(x - 1, 140));
    return sum;
  };
  EXPECT_LT(roughness("full", "5"), 0.1 * roughness("full", "0"));
  EXPECT_LT(roughness("half", "10"), 0.1 * roughness("half", "0"));
  EXPECT_LT(roughness("half", "9"), 0.3 * roughness("half", "0"));
}

// A floor that meets a wall, with a ledge a few texels wide between them.
scene::Scene ledgeScene() {
  scene::Scene scene = tests::cornerScene();
  tests::addQuad(scene,
                 {glm::vec3(-3, 0, 0.03f), {3, 0, 0.03f}, {3, 0.08f, 0.03f}, {-3, 0.08f, 0.03f}},
                 {0, 0, 1});
  tests::addQuad(scene,
                 {glm::vec3(-3, 0.08f, 0.03f), {3, 0.08f, 0.03f}, {3, 0.08f, 0}, {-3, 0.08f, 0}},
                 {0, 1, 0});
  return scene;
}

TEST_P(SlicesTest, EdgesThatRunAslantAreFreeOfThePattern) {
  const scene::Scene scene = ledgeScene();
  scene::Camera camera = {.eye = glm::dvec3(0, 1.2, 3), .target = glm::dvec3(0, 0, 0)};
  for (const double degrees : {27.0, 63.0}) {
    const double roll = glm::radians(degrees);
    camera.up = {std::sin(roll), std::cos(roll), 0};
    for (const char* resolution : {"full", "half"}) {
      // The remaining noise: the difference between a frame and the mean over the pattern's 25
      // frames.
      const auto noise = [&](const char* reach) {
        tests::AoFrames frames(device(), scene,
                               {{"resolution", resolution},
                                {"edge_slices", "1"},
                                {"edge_denoise", reach},
                                {"history", "25"}});
        const image::Image one = frames.show(camera, 240, 180);
        for (int k = 0; k < 23; ++k) frames.show(camera, 240, 180);
        return image::compare(one, frames.show(camera, 240, 180)).rmse;
      };
      EXPECT_LT(noise("6"), 0.805 * noise("0")) << resolution << ", " << degrees << " degrees";
    }
  }
}

TEST_P(SlicesTest, EdgesAreDenoisedAndNothingElse) {
  for (const char* resolution : kResolutions) {
    const auto rendered = [&](const char* reach) {
      const tests::Settings settings = {{"resolution", resolution}, {"edge_denoise", reach}};
      return tests::renderAo(device(), tests::cornerScene(), kCorner, settings, 320, 240);
    };
    const image::Image with = rendered("6"), without = rendered("0");
    // The crease is in the middle. Pixels near it, or near the picture's border, are all within the
    // denoiser's reach.
    size_t changed = 0;
    for (uint32_t y = 0; y < with.height; ++y) {
      for (uint32_t x = 0; x < with.width; ++x) {
        const bool far =
            std::abs(y - with.height / 2.0) > 60 && y > 40 && y < 200 && x > 40 && x < 280;
        const bool same = with.at(x, y) == without.at(x, y);
        changed += same ? 0 : 1;
        ASSERT_TRUE(same || !far) << resolution << " at " << x << ", " << y;
      }
    }
    EXPECT_GT(changed, 0u) << resolution;
    // Without the denoiser, the setting changes no pixel.
    const auto raw = [&](const char* reach) {
      const tests::Settings settings = {
          {"resolution", resolution}, {"blur_size", "0"}, {"edge_denoise", reach}};
      return tests::renderAo(device(), tests::cornerScene(), kCorner, settings).pixels;
    };
    EXPECT_EQ(raw("6"), raw("0")) << resolution;
  }
}

TEST(SlicesBackends, Agree) {
  const std::vector<tests::TestDevice> backends = tests::presentSystemDevices();
  if (backends.size() < 2) GTEST_SKIP() << "only one backend is present";
  for (const tests::Settings& settings :
       std::vector<tests::Settings>{{{"resolution", "full"}},
                                    {{"resolution", "half"}},
                                    {{"resolution", "quarter"}},
                                    {{"slices", "3"}, {"kernel_size", "36"}, {"blur_size", "0"}},
                                    {{"bias", "0.02"}}}) {
    std::vector<image::Image> images;
    for (const tests::TestDevice& backend : backends) {
      const auto device = tests::openDevice(backend);
      images.push_back(tests::renderAo(*device, tests::cornerScene(), kCorner, settings));
    }
    EXPECT_LT(image::shareOver(images[0], images[1], 2.0 / 255), 0.001) << join(settings);
  }
}

}  // namespace
}  // namespace grisaille
