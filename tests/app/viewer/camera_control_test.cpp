// SPDX-License-Identifier: MIT
#include "app/viewer/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <random>

#include "core/base/error.h"
#include "core/scene/view.h"

namespace grisaille::app::viewer {
namespace {

using scene::Camera;

constexpr double kHeight = 720;
constexpr double kWidth = 1280;

// Position of a world point in the picture, pixels.
glm::dvec2 pixelOf(const Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 view = glm::transpose(scene::worldFromView(camera)) * (point - camera.eye);
  return scene::pixelOf(scene::viewOf(camera, {kWidth, kHeight}), view);
}

double distanceOf(const Camera& camera) {
  return glm::length(camera.target - camera.eye);
}

// Angle of the view direction above the plane perpendicular to `up`, radians.
double elevationOf(const Camera& camera) {
  return std::asin(glm::dot(glm::normalize(camera.target - camera.eye), glm::normalize(camera.up)));
}

double randomIn(std::mt19937_64& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

glm::dvec3 randomDirection(std::mt19937_64& random) {
  for (;;) {
    const glm::dvec3 v(randomIn(random, -1, 1), randomIn(random, -1, 1), randomIn(random, -1, 1));
    if (glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
  }
}

Camera randomCamera(std::mt19937_64& random, double farthest, double leastLog, double mostLog) {
  for (;;) {
    Camera camera;
    camera.eye = farthest * randomIn(random, 0, 1) * randomDirection(random);
    camera.target =
        camera.eye + std::pow(10, randomIn(random, leastLog, mostLog)) * randomDirection(random);
    if (random() % 2 == 0) camera.up = randomDirection(random) * randomIn(random, 0.1, 10);
    camera.fovyDegrees = randomIn(random, 1, 170);
    try {
      scene::validate(camera);
      return camera;
    } catch (const Error&) {
      // Target too near for the eye's coordinates, or view parallel to `up`: try another camera.
    }
  }
}

TEST(CameraControl, DraggingTurnsTheSceneWithTheCursor) {
  const Camera camera{.eye = {0, 0, 5}, .target = {0, 0, 0}, .fovyDegrees = 50};
  // A point on the near side of the orbit's target.
  const glm::dvec3 front(0, 0, 1);
  const glm::dvec2 before = pixelOf(camera, front);
  for (const glm::dvec2 drag : {glm::dvec2(30, 0), {-30, 0}, {0, 30}, {0, -30}, {20, -10}}) {
    Camera turned = camera;
    orbit(turned, turned.target, drag, kHeight);
    const glm::dvec2 moved = pixelOf(turned, front) - before;
    EXPECT_GT(glm::dot(glm::normalize(moved), glm::normalize(drag)), 0.98);
    EXPECT_EQ(turned.target, camera.target);
  }
  Camera half = camera;
  orbit(half, half.target, {kHeight, 0}, kHeight);
  EXPECT_LT(glm::length(half.eye - glm::dvec3(0, 0, -5)), 1e-12);
}

TEST(CameraControl, OrbitKeepsTheDistanceAndGoesBack) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = randomCamera(random, 100, -2, 3);
    Camera turned = camera;
    const glm::dvec2 drag(randomIn(random, -500, 500), 0);
    orbit(turned, turned.target, drag, kHeight);
    EXPECT_NEAR(distanceOf(turned) / distanceOf(camera), 1, 1e-9);
    EXPECT_NEAR(elevationOf(turned), elevationOf(camera), 1e-7);
    orbit(turned, turned.target, -drag, kHeight);
    EXPECT_LT(glm::length(turned.eye - camera.eye), 1e-9 * (distanceOf(camera) + 100));
  }
}

TEST(CameraControl, PolesAreReachedAndNeverPassed) {
  std::mt19937_64 random(2);
  for (const double way : {1.0, -1.0}) {
    for (int i = 0; i < 200; ++i) {
      Camera orbiting = randomCamera(random, 10, -1, 2), looking = orbiting;
      const glm::dvec3 right = scene::worldFromView(orbiting)[0];
      for (int step = 0; step < 50; ++step) {
        orbit(orbiting, orbiting.target, {0, way * 100}, kHeight);
        look(looking, {0, way * 3000 / looking.fovyDegrees}, kHeight);
        ASSERT_GT(glm::dot(scene::worldFromView(orbiting)[0], right), 0.99);
        ASSERT_GT(glm::dot(scene::worldFromView(looking)[0], right), 0.99);
      }
      EXPECT_NEAR(elevationOf(orbiting), -way * (glm::half_pi<double>() - 0.01), 1e-6);
      EXPECT_NEAR(elevationOf(looking), -way * (glm::half_pi<double>() - 0.01), 1e-6);
    }
  }
}

TEST(CameraControl, PanKeepsThePointUnderTheCursor) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = randomCamera(random, 100, -1, 3);
    const glm::dvec2 drag(randomIn(random, -800, 800), randomIn(random, -800, 800));
    Camera moved = camera;
    pan(moved, drag, kHeight);
    // Any point at the target's depth.
    const glm::dmat3 axes = scene::worldFromView(camera);
    const glm::dvec3 point =
        camera.target + distanceOf(camera) *
                            (randomIn(random, -1, 1) * axes[0] + randomIn(random, -1, 1) * axes[1]);
    const glm::dvec2 expected = pixelOf(camera, point) + drag;
    EXPECT_LT(glm::length(pixelOf(moved, point) - expected), 1e-6 * (1 + glm::length(expected)));
    EXPECT_NEAR(distanceOf(moved) / distanceOf(camera), 1, 1e-9);
  }
}

// A surface point in front of a camera, at a random pixel and distance.
glm::dvec3 randomPoint(std::mt19937_64& random, const Camera& camera) {
  const glm::dvec2 pixel(randomIn(random, 0, kWidth), randomIn(random, 0, kHeight));
  return scene::worldPosition(scene::viewOf(camera, {kWidth, kHeight}), pixel,
                              distanceOf(camera) * std::pow(10, randomIn(random, -1, 1)));
}

TEST(CameraControl, ThePivotKeepsItsPixelAndItsDistance) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = randomCamera(random, 100, -1, 2);
    const glm::dvec3 pivot = randomPoint(random, camera);
    const glm::dvec2 pixel = pixelOf(camera, pivot);
    const glm::dvec3 right = scene::worldFromView(camera)[0];
    Camera turned = camera;
    orbit(turned, pivot, {randomIn(random, -500, 500), randomIn(random, -500, 500)}, kHeight);
    EXPECT_LT(glm::length(pixelOf(turned, pivot) - pixel), 1e-4);
    EXPECT_NEAR(glm::length(turned.eye - pivot) / glm::length(camera.eye - pivot), 1, 1e-9);
    EXPECT_NEAR(distanceOf(turned) / distanceOf(camera), 1, 1e-7);
    // No roll: the picture's horizon stays level.
    EXPECT_NEAR(glm::dot(scene::worldFromView(turned)[0], glm::normalize(camera.up)), 0, 1e-9);
    EXPECT_NEAR(glm::dot(right, glm::normalize(camera.up)), 0, 1e-9);
  }
}

TEST(CameraControl, ZoomKeepsThePointUnderThePointerAndNeverArrives) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = randomCamera(random, 100, -1, 2);
    const glm::dvec3 point = randomPoint(random, camera);
    const glm::dvec2 pixel = pixelOf(camera, point);
    const double away = glm::length(camera.eye - point);
    const auto depthIn = [&](const Camera& of) {
      return glm::dot(point - of.eye, -scene::worldFromView(of)[2]);
    };
    if (depthIn(camera) < 2 * camera.nearPlane) continue;
    Camera moved = camera;
    zoom(moved, point, -3);
    EXPECT_NEAR(glm::length(moved.eye - point), away / std::pow(0.9, 3), 1e-9 * away);
    EXPECT_LT(glm::length(pixelOf(moved, point) - pixel), 1e-4);
    zoom(moved, point, 3);
    EXPECT_LT(glm::length(moved.eye - camera.eye), 1e-9 * (away + 100));
    for (int notch = 0; notch < 300; ++notch) zoom(moved, point, 1);
    zoom(moved, point, 1e9);
    // The near plane does not cut the point off.
    EXPECT_NEAR(depthIn(moved), 2 * camera.nearPlane, 1e-5);
    zoom(moved, point, -100);
    EXPECT_GT(depthIn(moved), 100 * camera.nearPlane);
  }
}

TEST(CameraControl, TheTargetsDistanceDoesNotChangeThePicture) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 500; ++i) {
    const Camera camera = randomCamera(random, 10, -1, 2);
    Camera next = camera;
    const double metres = std::pow(10, randomIn(random, -1, 3));
    setTargetDistance(next, metres);
    EXPECT_NEAR(distanceOf(next), metres, 1e-9 * (metres + 10));
    EXPECT_EQ(next.eye, camera.eye);
    const glm::dvec3 before = scene::worldFromView(camera)[2],
                     after = scene::worldFromView(next)[2];
    EXPECT_GT(glm::dot(before, after), 1 - 1e-12);
    for (const double bad : {0.0, -1.0, std::nan(""), 1e300}) {
      Camera same = camera;
      setTargetDistance(same, bad);
      EXPECT_NO_THROW(scene::validate(same));
    }
  }
}

TEST(CameraControl, AFocusedPointIsInTheMiddleAtHalfTheDistance) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 500; ++i) {
    const Camera camera = randomCamera(random, 10, -1, 2);
    const glm::dvec3 point = randomPoint(random, camera);
    const double away = glm::length(point - camera.eye);
    if (away < 0.1 ||
        std::abs(glm::dot(glm::normalize(point - camera.eye), glm::normalize(camera.up))) > 0.99) {
      continue;  // above or below the eye
    }
    Camera next = camera;
    focus(next, point);
    EXPECT_EQ(next.target, point);
    EXPECT_NEAR(distanceOf(next), away / 2, 1e-9 * away);
    EXPECT_LT(glm::length(pixelOf(next, point) - glm::dvec2(kWidth, kHeight) / 2.0), 1e-6);
    // The eye stays on the ray to the point, where nothing is in its way.
    EXPECT_LT(glm::length(glm::cross(glm::normalize(next.eye - camera.eye),
                                     glm::normalize(point - camera.eye))),
              1e-7);
  }
}

TEST(CameraControl, AFramedBallTouchesTheBordersOfThePicture) {
  std::mt19937_64 random(9);
  for (const double aspect : {kWidth / kHeight, 1.0, 0.4}) {
    for (int i = 0; i < 200; ++i) {
      Camera camera = randomCamera(random, 10, -1, 2);
      camera.fovyDegrees = randomIn(random, 20, 100);
      const glm::dvec3 before = scene::worldFromView(camera)[2];
      const glm::dvec3 centre = 100 * randomIn(random, 0, 1) * randomDirection(random);
      const double radius = std::pow(10, randomIn(random, -0.5, 2));
      frameBall(camera, centre, radius, aspect);
      EXPECT_EQ(camera.target, centre);
      EXPECT_GT(glm::dot(scene::worldFromView(camera)[2], before), 1 - 1e-9);
      // The ball's silhouette is as wide as the narrower side.
      const double half = std::tan(glm::radians(camera.fovyDegrees) / 2) * std::min(aspect, 1.0);
      EXPECT_NEAR(std::asin(radius / distanceOf(camera)), std::atan(half), 1e-6);
    }
  }
}

TEST(CameraControl, LooksAlongEveryAxisWithoutRoll) {
  std::mt19937_64 random(10);
  for (int i = 0; i < 200; ++i) {
    Camera camera = randomCamera(random, 10, -1, 2);
    camera.up = {0, 1, 0};
    if (std::abs(elevationOf(camera)) > 1.5) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        glm::dvec3 from(0);
        from[axis] = sign;
        Camera next = camera;
        lookFrom(next, from);
        EXPECT_EQ(next.target, camera.target);
        EXPECT_NEAR(distanceOf(next) / distanceOf(camera), 1, 1e-9);
        EXPECT_GT(glm::dot(glm::normalize(next.eye - next.target), from), std::cos(0.011));
        if (axis != 1) continue;
        const glm::dmat3 now = scene::worldFromView(next), then = scene::worldFromView(camera);
        EXPECT_GT(glm::dot(now[0], then[0]), 0.999);
      }
    }
  }
}

TEST(CameraControl, LookingTurnsTheViewWithTheDrag) {
  Camera camera{.eye = {1, 2, 3}, .target = {1, 2, -1}, .fovyDegrees = 60};
  look(camera, {kHeight / 4, 0}, kHeight);
  EXPECT_EQ(camera.eye, glm::dvec3(1, 2, 3));
  // To the right, by half the field of view.
  EXPECT_NEAR(camera.target.x, 1 + 4 * 0.5, 1e-12);
  EXPECT_NEAR(camera.target.z, 3 - 4 * std::sqrt(0.75), 1e-12);
  look(camera, {0, -kHeight / 4}, kHeight);
  EXPECT_NEAR(elevationOf(camera), glm::radians(30.0), 1e-12);
  EXPECT_NEAR(distanceOf(camera), 4, 1e-12);
}

TEST(CameraControl, FlyingMovesAlongTheAxes) {
  const Camera camera{.eye = {1, 2, 3}, .target = {1, 1, 2}};
  const struct {
    glm::dvec3 axes, way;
  } cases[] = {{{1, 0, 0}, {6, 0, 0}},
               {{0, 1, 0}, {0, 6, 0}},
               {{0, 0, 1}, {0, -std::sqrt(18), -std::sqrt(18)}},
               {{-0.5, 0, 0}, {-3, 0, 0}},
               {{1, 1, 0}, {std::sqrt(18), std::sqrt(18), 0}},
               {{0, 0, 0}, {0, 0, 0}}};
  for (const auto& c : cases) {
    Camera moved = camera;
    fly(moved, c.axes, 1.5, 4);
    EXPECT_LT(glm::length(moved.eye - camera.eye - c.way), 1e-12);
    EXPECT_LT(glm::length(moved.target - camera.target - c.way), 1e-12);
  }
}

// At large coordinates, rounding would merge a near target with the eye: the target moves away.
TEST(CameraControl, FlyingFarAwayIsNotStoppedByANearTarget) {
  Camera camera{.eye = {0, 0, 0}, .target = {0, 0, -1e-3}};
  fly(camera, {0, 0, 1}, 1e6, 1e6);
  EXPECT_EQ(camera.eye.z, -1e12);
  look(camera, {100, 100}, kHeight);
  fly(camera, {0, 0, -1}, 1e6, 1e6);
  EXPECT_GT(camera.eye.z, -1e12);
}

TEST(CameraControl, SpeedFollowsTheDistanceAheadAndSteps) {
  EXPECT_EQ(flySpeed(8, 100), 4);
  EXPECT_LT(flySpeed(1, 100), flySpeed(2, 100));
  EXPECT_EQ(flySpeed(1e9, 100), 50);
  EXPECT_EQ(flySpeed(std::numeric_limits<double>::infinity(), 100), 50);  // sky
  EXPECT_EQ(flySpeed(0, 100), 0.05);                                      // a surface can be passed
  for (const double odd : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(flySpeed(1, odd), 0.5);
  }
  EXPECT_NEAR(steppedSpeed(4, 1), 5, 1e-12);
  EXPECT_NEAR(steppedSpeed(steppedSpeed(4, 7), -7), 4, 1e-12);
  EXPECT_EQ(steppedSpeed(4, 1e6), 64);
  EXPECT_EQ(steppedSpeed(4, -1e6), 1.0 / 64);
}

// Mostly a usual number, now and then one that no caller should pass.
double wild(std::mt19937_64& random, double usual) {
  const double odd[] = {0,
                        1e9,
                        -1e9,
                        1e300,
                        std::numeric_limits<double>::quiet_NaN(),
                        1e-300,
                        std::numeric_limits<double>::infinity()};
  return random() % 50 == 0 ? odd[random() % std::size(odd)] : randomIn(random, -usual, usual);
}

void actByChance(std::mt19937_64& random, Camera& camera) {
  const glm::dvec2 drag(wild(random, 600), wild(random, 600));
  const double height = random() % 200 == 0 ? wild(random, 1) : kHeight;
  const glm::dvec3 point(wild(random, 10), wild(random, 10), wild(random, 10));
  switch (random() % 9) {
    case 0:
      return orbit(camera, random() % 2 == 0 ? camera.target : point, drag, height);
    case 1:
      return pan(camera, drag, height);
    case 2:
      return zoom(camera, random() % 2 == 0 ? camera.target : point, wild(random, 20));
    case 3:
      return look(camera, drag, height);
    case 4:
      return setTargetDistance(camera, wild(random, 10));
    case 5:
      return focus(camera, point);
    case 6:
      return frameBall(camera, point, wild(random, 10), std::abs(wild(random, 2)));
    case 7:
      return lookFrom(camera, randomDirection(random));
    default:
      return fly(camera, {wild(random, 1), wild(random, 1), wild(random, 1)}, wild(random, 0.1),
                 std::pow(10, randomIn(random, -4, 9)));
  }
}

// From near and far, at the target and far away from it: valid after every action, never stuck.
TEST(CameraControl, StaysSoundWhateverIsDone) {
  std::mt19937_64 random(4);
  const struct {
    double farthest, leastLog, mostLog;
  } places[] = {{1, -9, -6}, {10, -1, 2}, {1e6, -2, 3}, {1e12, 4, 6}, {1e9, 10, 14}};
  for (const auto& place : places) {
    for (int start = 0; start < 5; ++start) {
      Camera camera = randomCamera(random, place.farthest, place.leastLog, place.mostLog);
      const Camera first = camera;
      size_t moved = 0;
      for (int i = 0; i < 10000; ++i) {
        const Camera before = camera;
        actByChance(random, camera);
        ASSERT_NO_THROW(scene::validate(camera)) << i;
        if (camera.eye != before.eye || camera.target != before.target) ++moved;
      }
      EXPECT_GT(moved, 3000u) << place.farthest;
      EXPECT_EQ(camera.up, first.up);
      EXPECT_EQ(camera.fovyDegrees, first.fovyDegrees);
      EXPECT_EQ(camera.nearPlane, first.nearPlane);
    }
  }
}

// GLFW tells halves and wholes of wheels, and on Wayland fractions of fingers.
TEST(Touchpad, FingersMoveByFractionsAndToTheSide) {
  for (const glm::dvec2 wheel : {glm::dvec2(0, 1), {0, -3}, {0, 0.5}, {0, -1.5}}) {
    EXPECT_FALSE(isOfFingers(wheel)) << wheel.y;
  }
  for (const glm::dvec2 fingers : {glm::dvec2(0, 0.1), {0, -1.3}, {1, 0}, {-0.2, 0.5}}) {
    EXPECT_TRUE(isOfFingers(fingers)) << fingers.x << ", " << fingers.y;
  }
}

}  // namespace
}  // namespace grisaille::app::viewer
