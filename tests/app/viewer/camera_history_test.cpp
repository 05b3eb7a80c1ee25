// SPDX-License-Identifier: MIT
#include "app/viewer/camera_history.h"

#include <gtest/gtest.h>

#include <random>

namespace grisaille::app::viewer {
namespace {

scene::Camera at(double x) {
  scene::Camera camera;
  camera.eye = {x, 0, 5};
  return camera;
}

TEST(CameraHistory, AtTheStartThereIsNowhereToGo) {
  CameraHistory history;
  history.begin(at(1));
  EXPECT_FALSE(history.back(at(1)));
  EXPECT_FALSE(history.forward(at(1)));
}

TEST(CameraHistory, GoesBackAndForthOverEveryPlace) {
  CameraHistory history;
  history.begin(at(0));
  for (int i = 1; i < 50; ++i) {
    history.note(at(i));
    history.note(at(i));  // a rest is no place of its own
  }
  for (int i = 48; i >= 0; --i) EXPECT_EQ(history.back(at(i + 1))->eye.x, i);
  EXPECT_FALSE(history.back(at(0)));
  for (int i = 1; i < 50; ++i) EXPECT_EQ(history.forward(at(i - 1))->eye.x, i);
  EXPECT_FALSE(history.forward(at(49)));
}

// back() from a place that is not noted yet returns to the last one, and forward() to the place.
TEST(CameraHistory, AMoveThatHasNotRestedIsKept) {
  CameraHistory history;
  history.begin(at(0));
  EXPECT_EQ(history.back(at(7))->eye.x, 0);
  EXPECT_EQ(history.forward(at(0))->eye.x, 7);
}

TEST(CameraHistory, AMoveForgetsThePlacesAhead) {
  CameraHistory history;
  history.begin(at(0));
  history.note(at(1));
  history.note(at(2));
  EXPECT_EQ(history.back(at(2))->eye.x, 1);
  history.note(at(9));
  EXPECT_FALSE(history.forward(at(9)));
  EXPECT_EQ(history.back(at(9))->eye.x, 1);
}

TEST(CameraHistory, KeepsTheLatestPlaces) {
  CameraHistory history;
  history.begin(at(0));
  constexpr int kMoves = 3000;
  for (int i = 1; i <= kMoves; ++i) history.note(at(i));
  int steps = 0;
  for (auto place = std::optional(at(kMoves)); (place = history.back(*place));) ++steps;
  EXPECT_EQ(steps, static_cast<int>(CameraHistory::kMost) - 1);
}

}  // namespace
}  // namespace grisaille::app::viewer
