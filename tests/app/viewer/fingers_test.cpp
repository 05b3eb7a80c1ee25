// SPDX-License-Identifier: MIT
// From the numbers that XInput tells of fingers to moves of the camera.
#include "app/viewer/fingers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/viewer/camera_control.h"

namespace grisaille::app::viewer {
namespace {

TEST(ScrollAxis, TheStepsOfAWaySumUpToIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-40, 40);
  for (const double increment : {15.0, 120.0, -15.0, 1.0}) {
    ScrollAxis axis(increment);
    double position = 1000, sum = 0;
    axis.moveTo(position);
    for (int i = 0; i < 200; ++i) sum += axis.moveTo(position += step(random));
    EXPECT_NEAR(sum, (1000 - position) / increment, 1e-9 * std::abs(position));
  }
}

// XInput counts to the right and down, GLFW to the left and up.
TEST(ScrollAxis, OneIncrementIsOneNotchOfAWheelBack) {
  ScrollAxis axis(120);
  axis.moveTo(0);
  EXPECT_EQ(axis.moveTo(120), -1);
  EXPECT_EQ(axis.moveTo(60), 0.5);
}

TEST(ScrollAxis, MovesInOtherWindowsDoNotCount) {
  ScrollAxis axis(15);
  EXPECT_EQ(axis.moveTo(1e6), 0);
  EXPECT_EQ(axis.moveTo(1e6 + 15), -1);
  axis.forget();
  EXPECT_EQ(axis.moveTo(-300), 0);
  EXPECT_EQ(axis.moveTo(-315), 1);
}

TEST(PinchScale, TheFactorsOfAPinchMultiplyToItsScale) {
  PinchScale pinch;
  for (const double end : {2.5, 0.3}) {
    pinch.begin();
    double product = 1;
    for (int i = 1; i <= 20; ++i) product *= pinch.moveTo(std::pow(end, i / 20.0));
    EXPECT_NEAR(product, end, 1e-12);
  }
}

TEST(PinchScale, NoScaleMovesTheCameraAway) {
  PinchScale pinch;
  pinch.begin();
  EXPECT_EQ(pinch.moveTo(2), 2);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(pinch.moveTo(bad), 1) << bad;
  }
  EXPECT_EQ(pinch.moveTo(3), 1.5);
}

// Fingers twice as far apart halve the distance; the point keeps its direction, hence its pixel.
TEST(Fingers, APinchMovesToThePointByItsScale) {
  const glm::dvec3 point(1, -2, -7);
  const scene::Camera before{.eye = {0, 1, 5}, .target = {0, 0, -3}};
  for (const double scale : {2.0, 1.25, 1.0, 0.5}) {
    scene::Camera camera = before;
    PinchScale pinchScale;
    pinchScale.begin();
    for (int i = 1; i <= 8; ++i) pinch(camera, point, pinchScale.moveTo(std::pow(scale, i / 8.0)));
    EXPECT_NEAR(glm::length(camera.eye - point), glm::length(before.eye - point) / scale, 1e-9);
    EXPECT_GT(glm::dot(glm::normalize(camera.eye - point), glm::normalize(before.eye - point)),
              1 - 1e-12);
    EXPECT_LT(glm::length(glm::normalize(camera.target - camera.eye) -
                          glm::normalize(before.target - before.eye)),
              1e-9);
  }
}

TEST(Fingers, APinchStopsBeforeThePoint) {
  const glm::dvec3 point(0, 0, -7);
  scene::Camera camera{.eye = {0, 0, 5}, .target = {0, 0, 0}};
  for (int i = 0; i < 100; ++i) pinch(camera, point, 10);
  EXPECT_GE(camera.eye.z, point.z + camera.nearPlane);
  EXPECT_LT(camera.eye.z, point.z + 10 * camera.nearPlane);
  EXPECT_NO_THROW(scene::validate(camera));
}

}  // namespace
}  // namespace grisaille::app::viewer
