// SPDX-License-Identifier: MIT
// Many shots, and shots and settings at their extremes, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/view.h"
#include "lab/oracle/paint.h"
#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

using namespace lab::oracle;

const scene::Camera kWall = {.eye = glm::dvec3(0, 0, 3), .target = glm::dvec3(0, 0, 0)};

class CrowdTest : public BackendTest {};
GRISAILLE_ON_EVERY_DEVICE(CrowdTest);

// The effect drops paint that newer paint hides, without a visible change. In a crease that every
// muzzle sees whole, dozens of layers deep, the picture equals the definition's with all shots.
// Places come from ray casts: in so small a picture, a rasteriser that snaps vertices to 1/16 pixel
// moves places farther off their surface than `surface` mode allows.
TEST_P(CrowdTest, HidingChangesNothing) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  frame::PictureAttachments places(&device());
  places.show(tracedPictures(rays.tracer(), kCrease, kWidth, kHeight));
  for (uint32_t seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<lab::Shot> shots;
    for (int i = 0; i < 400; ++i) {
      const glm::dvec3 origin(2 * unit(random) - 1, 0.4 + unit(random), 0.4 + unit(random));
      const bool floor = i % 2 == 0;
      const double along = 0.6 * unit(random);
      const glm::dvec3 target(0.6 * unit(random) - 0.3, floor ? 0 : along, floor ? along : 0);
      shots.push_back(shotAt(origin, target, randomColor(random)));
    }
    Settings settings = {{"paint_range", fmt::format("{}", 0.1 + 0.2 * unit(random))},
                         {"r0", seed % 2 == 0 ? "1" : "0.1"},
                         {"edge_fade", seed < 2 ? "0.5" : "0"},
                         {"splat_sharpness", "1"},
                         {"shot_limit", "65536"}};
    PaintFrame frame(device(), places);
    frame.setRays(&rays);
    frame.set(settings);
    frame.render(kCrease, kWidth, kHeight, shots);
    EXPECT_EQ(frame.waiting(), 0u);
    const image::Image paint = frame.read("paint"), coverage = frame.read("paint_coverage");
    settings.emplace_back("mode", "per_shot");
    frame.set(settings);
    frame.render(kCrease, kWidth, kHeight, shots);
    const image::Image every = frame.read("paint"), sum = frame.read("paint_coverage");
    size_t wrong = 0;
    for (size_t i = 0; i < coverage.pixels.size(); ++i) {
      float worst = std::abs(coverage.pixels[i] - sum.pixels[i]);
      for (size_t c = 4 * i; c < 4 * i + 4; ++c) {
        worst = std::max(worst, std::abs(paint.pixels[c] - every.pixels[c]));
      }
      wrong += worst > 2.0f / 255 ? 1 : 0;
    }
    EXPECT_LE(wrong, coverage.pixels.size() / 1000) << "seed " << seed;
  }
}

// A million shots at 140 places, then one more: each pixel shows the newest shot that reaches it.
TEST_P(CrowdTest, TheNewestWinsOfAMillion) {
  const scene::Scene scene = wallScene();
  TracedRays rays(scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::pair<glm::dvec3, glm::dvec3>> places;
  for (int i = 0; i < 140; ++i) {
    places.emplace_back(glm::dvec3(3 * unit(random) - 1.5, 2 * unit(random) - 1, 2),
                        glm::dvec3(3 * unit(random) - 1.5, 2 * unit(random) - 1, 0));
  }
  std::vector<lab::Shot> shots;
  std::vector<size_t> placeOf;
  for (int i = 0; i < 1'000'000; ++i) {
    placeOf.push_back(random() % places.size());
    const auto& [origin, target] = places[placeOf.back()];
    shots.push_back(shotAt(origin, target, randomColor(random)));
  }
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  frame.set({{"edge_fade", "0"}});
  const auto expectNewest = [&] {
    std::vector<size_t> newest(places.size());
    for (size_t i = 0; i < shots.size(); ++i) newest[placeOf[i]] = i;
    const image::Image owner = frame.read("paint_owner"), paint = frame.read("paint"),
                       depth = frame.read("depth");
    size_t painted = 0, wrong = 0;
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const glm::dvec3 p = scene::worldPosition(scene::viewOf(kWall, {kWidth, kHeight}),
                                                  {x + 0.5, y + 0.5}, double{depth.at(x, y)});
        size_t number = 0;
        for (const size_t i : newest) {
          const glm::dvec3 q =
              p - glm::dvec3(shots[i].origin[0], shots[i].origin[1], shots[i].origin[2]);
          const glm::dvec3 w(shots[i].direction[0], shots[i].direction[1], shots[i].direction[2]);
          if (glm::length(glm::cross(q, w)) < 0.25) number = std::max(number, i + 1);
        }
        painted += number > 0 ? 1 : 0;
        const bool right =
            owner.at(x, y) == static_cast<float>(number) &&
            (number == 0 || std::abs(paint.at(x, y, 1) - shots[number - 1].color[1]) < 2.0f / 255);
        wrong += right ? 0 : 1;
      }
    }
    EXPECT_GT(painted, kWidth * kHeight / 2u);
    EXPECT_LE(wrong, kWidth * kHeight / 200u);  // pixels on edges
  };
  const std::vector<std::string> outputs = {"paint", "paint_owner", "depth"};
  frame.render(kWall, kWidth, kHeight, shots, outputs);
  EXPECT_EQ(frame.waiting(), 0u);
  expectNewest();
  places.emplace_back(kWall.eye, kWall.target);
  placeOf.push_back(places.size() - 1);
  shots.push_back(shotAt(kWall.eye, kWall.target, glm::vec3(1, 0, 0)));
  frame.render(kWall, kWidth, kHeight, shots, outputs);
  EXPECT_EQ(frame.read("paint_owner").at(kWidth / 2, kHeight / 2), 1'000'001.0f);
  expectNewest();
  shots.resize(999'000);
  places.pop_back();
  frame.render(kWall, kWidth, kHeight, shots, outputs);
  expectNewest();
}

// Small splats all over the wall.
std::vector<lab::Shot> speckles(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 target(6 * unit(random) - 3, 4 * unit(random) - 2, 0);
    const glm::dvec3 offset(unit(random) - 0.5, unit(random) - 0.5, 1);
    shots.push_back(shotAt(target + offset, target, randomColor(random)));
  }
  return shots;
}

// When the memory is full, the oldest shots go: the picture is that of the others. What an undo or
// a larger limit frees serves the oldest again.
TEST_P(CrowdTest, TheOldestGoWhenTheMemoryIsFull) {
  const scene::Scene scene = wallScene();
  TracedRays rays(scene);
  const std::vector<lab::Shot> shots = speckles(13'000);
  const Settings rules = {{"paint_range", "0.03"}, {"edge_fade", "0"}};
  PaintFrame limited(device(), scene), free(device(), scene);
  limited.setRays(&rays);
  free.setRays(&rays);
  free.set(rules);
  const auto set = [&](const char* memory) {
    Settings all = rules;
    all.emplace_back("memory", memory);
    limited.set(all);
  };
  const auto givenUpOf = [&](size_t count) {
    limited.render(kWall, kWidth, kHeight, std::span(shots).first(count));
    EXPECT_EQ(limited.waiting(), 0u);
    const size_t givenUp = limited.givenUp();
    free.render(kWall, kWidth, kHeight, std::span(shots).first(count).subspan(givenUp));
    EXPECT_EQ(free.givenUp(), 0u);
    EXPECT_EQ(limited.read("paint").pixels, free.read("paint").pixels) << count;
    return givenUp;
  };
  set("16");
  const size_t first = givenUpOf(12'000);
  EXPECT_GT(first, 1000u);
  EXPECT_LT(first, 11'000u);
  const size_t second = givenUpOf(13'000);
  EXPECT_GT(second, first);
  EXPECT_LT(givenUpOf(9'000), second);
  set("256");
  EXPECT_EQ(givenUpOf(9'000), 0u);
  set("16");
  EXPECT_GT(givenUpOf(11'000), 0u);
  set("1000");
  EXPECT_EQ(givenUpOf(10'000), 0u);
  set("16");
  EXPECT_GT(givenUpOf(11'000), 0u);
}

// Undo is exact at the limit too: the shots that newer ones had pushed out are back.
TEST_P(CrowdTest, UndoBringsBackWhatTheLimitTook) {
  const scene::Scene scene = wallScene();
  TracedRays rays(scene);
  const std::vector<lab::Shot> shots = speckles(13'000);
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  frame.set({{"paint_range", "0.03"}, {"edge_fade", "0"}, {"memory", "16"}});
  const auto pictureOf = [&](size_t count) {
    frame.render(kWall, kWidth, kHeight, std::span(shots).first(count));
    EXPECT_EQ(frame.waiting(), 0u);
    return frame.read("paint").pixels;
  };
  size_t count = 11'000, tested = 0;
  auto before = pictureOf(count);
  for (; count + 100 <= shots.size(); count += 100) {
    const size_t givenUp = frame.givenUp();
    const auto after = pictureOf(count + 100);
    if (frame.givenUp() > givenUp) {
      ++tested;
      EXPECT_EQ(pictureOf(count), before) << count;
      EXPECT_EQ(frame.givenUp(), givenUp) << count;
    }
    before = pictureOf(count + 100);
  }
  EXPECT_GT(tested, 0u);
}

// All shots on one spot: the newest colour shows, even where its alpha is low.
TEST_P(CrowdTest, AMillionOnOneSpot) {
  const scene::Scene scene = wallScene();
  TracedRays rays(scene);
  for (const char* full : {"1", "0.002"}) {
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    frame.set({{"r0", full}, {"edge_fade", "0"}});
    std::vector<lab::Shot> shots(1'000'000,
                                 shotAt(kWall.eye, kWall.target, glm::vec3(0.25, 0.5, 0.75)));
    frame.render(kWall, kWidth, kHeight, shots);
    EXPECT_EQ(frame.waiting(), 0u);
    const image::Image paint = frame.read("paint"), coverage = frame.read("paint_coverage");
    for (uint32_t c = 0; c < 4; ++c) {
      const float expected[] = {0.25f, 0.5f, 0.75f, 1};
      EXPECT_NEAR(paint.at(kWidth / 2 + 3, kHeight / 2 + 2, c), expected[c], 2.0f / 255) << full;
    }
    EXPECT_EQ(coverage.at(kWidth / 2 + 3, kHeight / 2 + 2), 1.0f);
    EXPECT_EQ(coverage.at(0, 0), 0.0f);
  }
}

// A shot counts its twins once, whatever led to the list: changed rules and undo count anew.
TEST_P(CrowdTest, TwinsCountOnce) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  std::mt19937 random(11);
  std::vector<lab::Shot> shots;
  for (int i = 0; i < 24; ++i) {
    // Four rays in turn: the last shot of each stands for five others.
    const double x = 0.15 * (i % 4) - 0.2;
    shots.push_back(shotAt({x, 0.6, 1}, {x, 0.4, 0}, randomColor(random)));
  }
  const auto pictureOf = [&](PaintFrame& frame, const Settings& settings, size_t count) {
    frame.set(settings);
    frame.render(kCrease, kWidth, kHeight, std::span(shots).first(count));
    return std::pair(frame.read("paint").pixels, frame.read("paint_coverage").pixels);
  };
  const auto settingsOf = [](const char* fade) {
    return Settings{{"r0", "0.01"}, {"edge_fade", fade}};
  };
  PaintFrame frame(device(), scene);
  frame.setRays(&rays);
  for (const auto& [fade, count] : {std::pair("0.5", 24u), std::pair("0.3", 24u),
                                    std::pair("0.3", 22u), std::pair("0.5", 24u)}) {
    PaintFrame fresh(device(), scene);
    fresh.setRays(&rays);
    EXPECT_EQ(pictureOf(frame, settingsOf(fade), count), pictureOf(fresh, settingsOf(fade), count))
        << fade << ", " << count;
  }
}

// Every setting at the ends of its range, shots from far and near: finite results, and never a
// hang.
TEST_P(CrowdTest, ExtremesStayFinite) {
  const scene::Scene scene = cornerScene();
  TracedRays rays(scene);
  std::mt19937 random(3);
  const auto either = [&](const char* low, const char* middle, const char* high) {
    const auto which = random() % 3;
    return std::string(which == 0 ? low : which == 1 ? middle : high);
  };
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 24; ++round) {
    std::vector<lab::Shot> shots;
    for (int i = 0; i < 12; ++i) {
      const double scale = std::pow(10.0, 8 * unit(random) - 2);
      const glm::dvec3 origin(scale * (unit(random) - 0.5), scale * unit(random),
                              scale * unit(random));
      const auto range = static_cast<float>(i % 3 == 0 ? 0 : std::pow(10.0, 12 * unit(random) - 6));
      shots.push_back(shotAt(origin, glm::dvec3(unit(random) - 0.5, unit(random), 0),
                             randomColor(random), range));
    }
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    frame.set({{"mode", round % 2 == 0 ? "surface" : "per_shot"},
               {"paint_range", either("1e-6", "0.25", "1e6")},
               {"r0", either("1e-6", "0.1", "1e6")},
               {"edge_fade", either("0", "0.5", "1")},
               {"splat_scale", either("1e-6", "0.06", "1e6")},
               {"splat_sharpness", either("0", "0.9", "1")},
               {"noise_seed", either("0", "77", "65535")}});
    frame.render(kCrease, kWidth, kHeight, shots);
    for (const char* output : {"paint", "paint_coverage"}) {
      const image::Image picture = frame.read(output);
      EXPECT_TRUE(std::ranges::all_of(picture.pixels, [](float v) { return v >= 0 && v <= 1; }))
          << output << ", round " << round;
    }
  }
}

// Distant splats smaller than pixels stay steady while the camera moves by less than a pixel.
TEST_P(CrowdTest, FarSplatsDoNotShimmer) {
  const scene::Scene scene = wallScene();
  TracedRays rays(scene);
  // One shot with alpha from 1 to 0.03 across the picture: the noise decides coverage.
  const std::vector<lab::Shot> shots = {
      shotAt(glm::dvec3(0, 0, 5), glm::dvec3(0, 0, 0), glm::vec3(1, 1, 1), 15)};
  const auto change = [&](const char* scale) {
    PaintFrame frame(device(), scene);
    frame.setRays(&rays);
    frame.set({{"r0", "3"}, {"edge_fade", "0"}, {"splat_scale", scale}});
    std::vector<float> first;
    double worst = 0;
    for (int step = 0; step < 4; ++step) {
      const double pixel = 2 * std::tan(glm::radians(30.0)) * 15 / kHeight;
      scene::Camera camera = {.eye = glm::dvec3(0.21 * step * pixel, 0.17 * step * pixel, 15),
                              .target = glm::dvec3(0.21 * step * pixel, 0.17 * step * pixel, 0)};
      frame.render(camera, kWidth, kHeight, shots);
      const std::vector<float> now = frame.read("paint").pixels;
      if (step > 0) {
        double sum = 0;
        for (size_t i = 3; i < now.size(); i += 4) sum += std::abs(now[i] - first[i]);
        worst = std::max(worst, sum / (static_cast<double>(now.size()) / 4));
      }
      first = now;
    }
    return worst;
  };
  // Cells of 1/8 pixel; then of 8 pixels, to show that the test can fail.
  EXPECT_LT(change("0.03"), 0.005);
  EXPECT_GT(change("2"), 0.02);
}

}  // namespace
}  // namespace grisaille::tests
