// SPDX-License-Identifier: MIT
// What makes paint look like paint, as figures: rims without direction, streaks along the shots on
// grazing hits, and spray without regular gaps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kPixels = 256;
constexpr double kHalfView = 1.5;  // metres of the wall, from the picture's centre to its sides
constexpr float kSplatRange = 0.25f;

// A wall in front of a camera that looks at it straight on, so that pixels are squares of it.
class LooksTest : public BackendTest {
 protected:
  LooksTest() {
    scene_.materials.emplace_back();
    addQuad(scene_,
            {glm::vec3(-4, -4, 0), glm::vec3(4, -4, 0), glm::vec3(4, 4, 0), glm::vec3(-4, 4, 0)},
            glm::vec3(0, 0, 1));
  }

  // Alphas of the pixels after shots.
  std::vector<double> paint(const std::vector<lab::Shot>& shots) {
    TracedRays rays(scene_);
    PaintFrame frame(device(), scene_);
    frame.setRays(&rays);
    const scene::Camera camera = {
        .eye = glm::dvec3(0, 0, 3), .target = glm::dvec3(0), .orthographicHeight = 2 * kHalfView};
    frame.render(camera, kPixels, kPixels, shots, {"paint"});
    const image::Image paint = frame.read("paint");
    std::vector<double> alphas(size_t{kPixels} * kPixels);
    for (size_t i = 0; i < alphas.size(); ++i) alphas[i] = double{paint.pixels[4 * i + 3]};
    return alphas;
  }

 private:
  scene::Scene scene_;
};
GRISAILLE_ON_EVERY_DEVICE(LooksTest);

// Shots at places of the wall, all along one direction.
std::vector<lab::Shot> shotsAt(const std::vector<glm::dvec2>& places, const glm::dvec3& direction) {
  std::vector<lab::Shot> shots;
  for (const glm::dvec2& place : places) {
    const glm::dvec3 target(place, 0);
    shots.push_back(shotAt(target - 2.0 * direction, target, glm::vec3(1, 0, 0), kSplatRange));
  }
  return shots;
}

// Places that are too far apart for their splats to meet, each a little off its row and column.
std::vector<glm::dvec2> apartPlaces(double step, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-0.03, 0.03);
  std::vector<glm::dvec2> places;
  const int count = static_cast<int>(2 * kHalfView / step);
  const auto at = [&](int i) { return (i + 0.5) * step - kHalfView + off(random); };
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < count; ++x) {
      const double down = at(y);
      places.emplace_back(at(x), down);
    }
  }
  return places;
}

// Sums over a picture of the products of its gradients: xx, xy, yy.
glm::dvec3 structureOf(const std::vector<double>& alphas) {
  glm::dvec3 sums(0);
  for (size_t y = 1; y + 1 < kPixels; ++y) {
    for (size_t x = 1; x + 1 < kPixels; ++x) {
      const double* at = &alphas[y * kPixels + x];
      const double dx = at[1] - at[-1];
      const double dy = at[kPixels] - at[-int{kPixels}];
      sums += glm::dvec3(dx * dx, dx * dy, dy * dy);
    }
  }
  return sums;
}

// 0: rims run in all directions alike; 1: all in one.
double directednessOf(const glm::dvec3& structure) {
  const double difference = structure.x - structure.z;
  return std::sqrt(difference * difference + 4 * structure.y * structure.y) /
         (structure.x + structure.z);
}

TEST_P(LooksTest, RimsHaveNoDirection) {
  glm::dvec3 sums(0);
  for (uint32_t round = 0; round < 4; ++round) {
    sums += structureOf(paint(shotsAt(apartPlaces(0.55, round), glm::dvec3(0, 0, -1))));
  }
  fmt::print("{}: rims run in one direction by {:.4f}\n", GetParam().label, directednessOf(sums));
  EXPECT_LE(directednessOf(sums), 0.03);
}

TEST_P(LooksTest, GrazingShotsLeaveStreaksAlongTheirWay) {
  const double slant = 0.45;  // radians between the shots and the wall
  double alongWay = 0, acrossWay = 0;
  for (uint32_t round = 0; round < 10; ++round) {
    const double turn = 0.7 * round;
    const glm::dvec2 way(std::cos(turn), std::sin(turn));
    const std::vector<double> alphas = paint(
        shotsAt({glm::dvec2(0.01 * round)}, glm::dvec3(std::cos(slant) * way, -std::sin(slant))));
    for (size_t i = 0; i < alphas.size(); ++i) {
      const glm::dvec2 pixel(i % kPixels, kPixels - 1 - i / kPixels);  // rows go down
      const glm::dvec2 at = (pixel + 0.5) * (2 * kHalfView / kPixels) - kHalfView - 0.01 * round;
      alongWay += alphas[i] * std::pow(glm::dot(at, way), 2);
      acrossWay += alphas[i] * std::pow(at.x * way.y - at.y * way.x, 2);
    }
  }
  // Width and length of a stain: docs/design/sspm.md, "Lobes and drops".
  const double stretch = std::sqrt(alongWay / acrossWay) * std::sin(slant);
  fmt::print("{}: length / width of a stain, times the sine: {:.3f}\n", GetParam().label, stretch);
  EXPECT_NEAR(stretch, 1, 0.15);
}

// Correlation of a picture with itself, for lags up to a range.
class Correlation {
 public:
  void add(const std::vector<double>& alphas) {
    const auto at = [&](int x, int y) {
      return alphas[static_cast<size_t>(y) * kPixels + static_cast<size_t>(x)];
    };
    const int from = kMost, to = static_cast<int>(kPixels) - kMost;
    double mean = 0;
    for (int y = from; y < to; ++y) {
      for (int x = from; x < to; ++x) mean += at(x, y);
    }
    mean /= (to - from) * (to - from);
    for (int j = 0; j <= kMost; ++j) {
      for (int i = -kMost; i <= kMost; ++i) {
        double sum = 0;
        for (int y = from; y < to; y += 3) {
          for (int x = from; x < to; x += 3) sum += (at(x, y) - mean) * (at(x + i, y + j) - mean);
        }
        lag(i, j) += sum;
      }
    }
  }

  // By how much a lag's correlation is above the mean of all lags of its length, at most. A lattice
  // has such lags; places without order have none.
  double mostRegular() const {
    std::array<double, kMost + 1> means = {}, counts = {};
    const auto forEach = [&](const auto& visit) {
      for (int j = 0; j <= kMost; ++j) {
        for (int i = -kMost; i <= kMost; ++i) {
          const auto length = static_cast<size_t>(std::lround(std::hypot(i, j)));
          if (length <= kMost && length > 0) visit(length, correlation(i, j));
        }
      }
    };
    forEach([&](size_t length, double value) {
      means[length] += value;
      counts[length] += 1;
    });
    double most = 0;
    forEach([&](size_t length, double value) {
      most = std::max(most, value - means[length] / counts[length]);
    });
    return most;
  }

 private:
  static constexpr int kMost = 32;  // pixels

  static size_t indexOf(int i, int j) {
    const int index = j * (2 * kMost + 1) + i + kMost;
    return static_cast<size_t>(index);
  }
  double& lag(int i, int j) { return sums_[indexOf(i, j)]; }
  double correlation(int i, int j) const { return sums_[indexOf(i, j)] / sums_[indexOf(0, 0)]; }

  std::array<double, (2 * kMost + 1) * (kMost + 1)> sums_ = {};
};

// Spray that covers most of the wall. direction: of the shots.
double regularityOfSpray(const glm::dvec3& direction, const auto& paint) {
  Correlation correlation;
  for (uint32_t round = 0; round < 8; ++round) {
    std::mt19937 random(round + 1);
    std::uniform_real_distribution<double> place(-2, 2);
    std::vector<glm::dvec2> places(200);
    for (glm::dvec2& each : places) each = {place(random), place(random)};
    correlation.add(paint(shotsAt(places, direction)));
  }
  return correlation.mostRegular();
}

TEST_P(LooksTest, SprayLeavesNoRegularGaps) {
  const auto painted = [&](const std::vector<lab::Shot>& shots) { return paint(shots); };
  const double straight = regularityOfSpray(glm::dvec3(0, 0, -1), painted);
  const double slanted = regularityOfSpray(glm::normalize(glm::dvec3(2, 0, -1)), painted);
  fmt::print("{}: regularity of spray {:.3f}, of slanted spray {:.3f}\n", GetParam().label,
             straight, slanted);
  EXPECT_LE(straight, 0.08);
  // The measure sees order where there is some.
  EXPECT_GE(slanted, 0.15);
}

}  // namespace
}  // namespace grisaille::tests
