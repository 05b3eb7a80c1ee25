// SPDX-License-Identifier: MIT
// Near the limit of memory the oldest paint gets coarser, before it goes. Shots over boxes before a
// wall have large maps.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/effects/sspm/paint_frame.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kAcross = 640, kDown = 400;
constexpr size_t kStep = 50;  // shots that come between two frames
const scene::Camera kBefore = {.eye = glm::dvec3(0, 0, 3.5), .target = glm::dvec3(0, 0, 0)};

scene::Scene clutter() {
  scene::Scene scene = wallScene(8, 8);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 place(6 * unit(random) - 3, 4 * unit(random) - 2, 0.3 * unit(random));
    const glm::dvec3 axis(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    const glm::dmat4 turned =
        glm::rotate(glm::translate(glm::dmat4(1), place), 6 * unit(random), glm::normalize(axis));
    addBox(scene, glm::scale(turned, glm::dvec3(0.02 + 0.06 * unit(random))));
  }
  computeBounds(scene);
  return scene;
}

std::vector<lab::Shot> spray(size_t count) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<lab::Shot> shots;
  while (shots.size() < count) {
    const glm::dvec3 target(5 * unit(random) - 2.5, 3 * unit(random) - 1.5, 0);
    const glm::dvec3 way(unit(random) - 0.5, unit(random) - 0.5, 1.5 + unit(random));
    shots.push_back(shotAt(target + way, target, randomColor(random)));
  }
  return shots;
}

struct Painting {
  std::vector<float> paint, owner;
  bool operator==(const Painting&) const = default;
};

class LimitTest : public BackendTest {
 protected:
  LimitTest() : scene_(clutter()), rays_(scene_) {}

  void start(PaintFrame& frame, const char* memory) {
    frame.setRays(&rays_);
    set(frame, memory);
  }
  // Every shot covers what is older.
  static void set(PaintFrame& frame, const char* memory) {
    frame.set({{"edge_fade", "0"}, {"splat_sharpness", "1"}, {"r0", "10"}, {"memory", memory}});
  }
  // The shots from `had` on come a few at a time, as in a match.
  void fire(PaintFrame& frame, size_t had, size_t count) {
    while (had < count) {
      had = std::min(had + kStep, count);
      frame.render(kBefore, 16, 16, std::span(shots_).first(had), {"paint"});
      EXPECT_EQ(frame.waiting(), 0u);
    }
  }
  // All of these shots, in as many frames as it takes.
  static void settle(PaintFrame& frame, std::span<const lab::Shot> shots) {
    frame.setPatience(0.05);
    do {
      frame.render(kBefore, 16, 16, shots, {"paint"});
    } while (frame.waiting() > 0);
    frame.setPatience(std::numeric_limits<double>::infinity());
  }
  // share: of the picture's width and height.
  Painting look(PaintFrame& frame, size_t count, uint32_t share = 4) {
    frame.render(kBefore, kAcross / share, kDown / share, std::span(shots_).first(count),
                 {"paint", "paint_owner"});
    EXPECT_EQ(frame.waiting(), 0u);
    return {frame.read("paint").pixels, frame.read("paint_owner").pixels};
  }

  scene::Scene scene_;
  TracedRays rays_;
  std::vector<lab::Shot> shots_ = spray(3600);
};
GRISAILLE_ON_EVERY_DEVICE(LimitTest);

// Whether the owner changes within two pixels of a pixel.
bool isAtRim(const std::vector<float>& owner, uint32_t x, uint32_t y) {
  for (uint32_t v = y - std::min(y, 2u); v <= std::min(y + 2, kDown - 1); ++v) {
    for (uint32_t u = x - std::min(x, 2u); u <= std::min(x + 2, kAcross - 1); ++u) {
      if (owner[size_t{v} * kAcross + u] != owner[size_t{y} * kAcross + x]) return true;
    }
  }
  return false;
}

struct Difference {
  size_t painted = 0, wrong = 0;       // pixels with paint away from rims; those that differ
  size_t newest = 0, newestWrong = 0;  // pixels of the newest fifth's paint; those that differ
  size_t all = 0;                      // pixels that differ at all
};

// givenUp: number of leading shots of `count` that the exact painting does not have.
Difference compare(const Painting& exact, const Painting& coarse, size_t count, size_t givenUp) {
  Difference sum;
  for (uint32_t y = 0; y < kDown; ++y) {
    for (uint32_t x = 0; x < kAcross; ++x) {
      const size_t i = size_t{y} * kAcross + x;
      float apart = 0;
      for (size_t c = 4 * i; c < 4 * i + 4; ++c) {
        apart = std::max(apart, std::abs(exact.paint[c] - coarse.paint[c]));
      }
      sum.all += apart > 0 ? 1 : 0;
      const auto owner = static_cast<size_t>(exact.owner[i]) + givenUp;
      if (exact.owner[i] > 0 && owner > givenUp + (count - givenUp) * 4 / 5) {
        ++sum.newest;
        sum.newestWrong += apart > 0 ? 1 : 0;
      }
      if (exact.owner[i] == 0 || isAtRim(exact.owner, x, y)) continue;
      ++sum.painted;
      sum.wrong += apart > 2.0f / 255 ? 1 : 0;
    }
  }
  return sum;
}

// Away from rims, 99 % of the pixels with paint differ by at most 2/255 from exact paint, and none
// with paint of the newest fifth differs, which are among the newest quarter of those that show.
// Nothing is given up before paint gets coarser.
TEST_P(LimitTest, CoarsePaintIsCloseAndTheNewestIsExact) {
  PaintFrame limited(device(), scene_), free(device(), scene_);
  start(limited, "16");
  start(free, "1000");
  size_t count = 0;
  while (limited.coarser() * 2 < count || limited.coarser() == 0) {
    ASSERT_LT(count, shots_.size()) << "paint must get coarser";
    fire(limited, count, count + kStep);
    count += kStep;
    if (limited.givenUp() > 0) break;
  }
  EXPECT_GT(limited.coarser() * 3, count) << "a third is coarse before the first shot goes";
  const size_t givenUp = limited.givenUp();
  const Painting coarse = look(limited, count, 1);
  free.render(kBefore, kAcross, kDown, std::span(shots_).first(count).subspan(givenUp),
              {"paint", "paint_owner"});
  EXPECT_EQ(free.coarser(), 0u);
  const Painting exact = {free.read("paint").pixels, free.read("paint_owner").pixels};
  const Difference apart = compare(exact, coarse, count, givenUp);
  std::printf("%s: %zu shots, %zu coarser, %zu given up; away from rims %zu of %zu px differ\n",
              GetParam().label.c_str(), count, size_t{limited.coarser()}, givenUp, apart.wrong,
              apart.painted);
  EXPECT_GT(apart.painted, kAcross * kDown / 4u);
  EXPECT_GT(apart.newest, kAcross * kDown / 8u);
  EXPECT_GT(apart.all, 0u) << "coarse paint must differ somewhere";
  EXPECT_LE(apart.wrong * 100, apart.painted);
  EXPECT_EQ(apart.newestWrong, 0u);
}

// The same of a list that comes at once, of which the oldest shots are never placed exactly. More
// memory makes all of it exact.
TEST_P(LimitTest, ALoadedListIsCloseWhereItIsCoarse) {
  constexpr size_t kCount = 2000;
  PaintFrame limited(device(), scene_), free(device(), scene_);
  start(limited, "16");
  start(free, "1000");
  settle(limited, std::span(shots_).first(kCount));
  const Painting coarse = look(limited, kCount, 1), exact = look(free, kCount, 1);
  const size_t coarser = limited.coarser(), givenUp = limited.givenUp();
  const Difference apart = compare(exact, coarse, kCount, 0);
  std::printf("%s: at once %zu shots, %zu coarser, %zu given up; away from rims %zu of %zu px\n",
              GetParam().label.c_str(), kCount, coarser, givenUp, apart.wrong, apart.painted);
  EXPECT_GT(coarser, kCount / 20);
  EXPECT_EQ(givenUp, 0u);
  EXPECT_GT(apart.all, 0u) << "coarse paint must differ somewhere";
  EXPECT_LE(apart.wrong * 100, apart.painted);
  set(limited, "1000");
  EXPECT_EQ(look(limited, kCount, 1), exact);
  EXPECT_EQ(limited.coarser(), 0u);
}

// The same where undo leaves so few shots that all fit: surveys for coarse maps alone must not
// stay.
TEST_P(LimitTest, ALoadedListIsExactAfterUndo) {
  constexpr size_t kCount = 2000, kLeft = 700;
  PaintFrame limited(device(), scene_), free(device(), scene_);
  start(limited, "16");
  start(free, "1000");
  settle(limited, std::span(shots_).first(kCount));
  ASSERT_GT(limited.coarser(), kCount / 20) << "how many are depends on the time that frames take";
  settle(limited, std::span(shots_).first(kLeft));
  EXPECT_EQ(look(limited, kLeft, 1), look(free, kLeft, 1));
  EXPECT_EQ(limited.coarser(), 0u);
}

// However long the match: the number of shots that are not given up never falls by much at once.
// Space of former maps is in pieces then, of which none may be large enough for the next map. What
// goes is a tenth of the shots that show, and the hidden ones before them.
TEST_P(LimitTest, PaintDoesNotCollapseInALongMatch) {
  PaintFrame frame(device(), scene_);
  start(frame, "16");
  const std::vector<lab::Shot> shots = spray(5000);
  size_t drawn = 0;
  for (size_t count = 100; count <= shots.size(); count += 100) {
    frame.render(kBefore, 16, 16, std::span(shots).first(count), {"paint"});
    const size_t now = count - size_t{frame.givenUp()};
    ASSERT_GT(now, drawn / 2) << "after " << count << " shots";
    drawn = now;
  }
  EXPECT_GT(frame.givenUp() + frame.coarser(), shots.size() / 10);
}

// Undo, a larger limit and a new list give exact paint back, also where undo leaves some coarse.
TEST_P(LimitTest, ExactPaintComesBack) {
  PaintFrame frame(device(), scene_);
  start(frame, "16");
  size_t count = 0, tested = 0;
  Painting before;
  for (; count + 100 <= shots_.size() && tested < 2; count += 100) {
    const uint64_t coarser = frame.coarser(), givenUp = frame.givenUp();
    before = look(frame, count);
    fire(frame, count, count + 100);
    if (frame.coarser() == coarser && frame.givenUp() == givenUp) continue;
    ++tested;
    EXPECT_NE(look(frame, count + 100), before) << "the shots must show";
    EXPECT_EQ(look(frame, count), before) << count;
    EXPECT_EQ(frame.coarser(), coarser) << count;
    EXPECT_EQ(frame.givenUp(), givenUp) << count;
    fire(frame, count, count + 100);
  }
  EXPECT_EQ(tested, 2u);
  EXPECT_GT(frame.coarser(), 0u);
  PaintFrame free(device(), scene_);
  start(free, "1000");
  const Painting exact = look(free, count);
  EXPECT_NE(look(frame, count), exact);
  set(frame, "1000");
  EXPECT_EQ(look(frame, count), exact);
  EXPECT_EQ(frame.coarser(), 0u);
  EXPECT_EQ(frame.givenUp(), 0u);
  set(frame, "16");
  look(frame, shots_.size());
  EXPECT_GT(frame.coarser() + frame.givenUp(), 0u);
  look(frame, 0);
  EXPECT_EQ(frame.coarser(), 0u);
}

// Shots come that hide coarse paint, and make a pass look for hidden shots and paint get coarser
// still. Undone, they leave no trace: coarse paint was surveyed before it got coarser, and is
// surveyed again. After very many, slivers may show that a pass had hidden; none is lost.
TEST_P(LimitTest, CoarsePaintIsTheSameAfterUndo) {
  PaintFrame frame(device(), scene_);
  start(frame, "16");
  size_t count = 0;
  while (frame.coarser() < 400 && count + kStep <= shots_.size()) {
    fire(frame, count, count + kStep);
    count += kStep;
  }
  const uint64_t coarser = frame.coarser(), givenUp = frame.givenUp();
  ASSERT_GE(coarser, 400u);
  const Painting before = look(frame, count, 1);
  for (const size_t hiding : {200, 1000}) {
    std::vector<lab::Shot> more(shots_.begin(), shots_.begin() + static_cast<ptrdiff_t>(count));
    for (const lab::Shot& shot : spray(hiding)) {
      more.push_back(shot);
      more.back().range = 0.8;
    }
    settle(frame, more);
    EXPECT_GT(frame.coarser() + frame.givenUp(), coarser + givenUp) << "paint must get coarser";
    settle(frame, std::span(shots_).first(count));
    const Painting after = look(frame, count, 1);
    size_t lost = 0, apart = 0;
    for (size_t i = 0; i < before.owner.size(); ++i) {
      lost += after.owner[i] < before.owner[i] ? 1 : 0;
      apart += after.owner[i] != before.owner[i] ? 1 : 0;
    }
    EXPECT_EQ(lost, 0u) << "after " << hiding << " shots";
    EXPECT_LE(apart, hiding / 1000 * before.owner.size() / 10000) << "after " << hiding << " shots";
    EXPECT_EQ(frame.coarser(), coarser);
    EXPECT_EQ(frame.givenUp(), givenUp);
  }
}

// A few shots come in each frame, so that arrays move to larger ones during several frames, and are
// written meanwhile: the paint is that of all shots at once.
TEST_P(LimitTest, ArraysThatMoveLoseNothing) {
  PaintFrame frame(device(), scene_);
  start(frame, "256");
  for (size_t count = 2; count <= 600; count += 2) {
    frame.render(kBefore, 16, 16, std::span(shots_).first(count), {"paint"});
    if (count % 150 != 0) continue;
    PaintFrame fresh(device(), scene_);
    start(fresh, "256");
    EXPECT_EQ(look(frame, count), look(fresh, count)) << count;
  }
}

// A host that answers no rays keeps coarse paint until it answers them again.
TEST_P(LimitTest, CoarsePaintStaysUntilItsRaysAreAnswered) {
  PaintFrame frame(device(), scene_);
  start(frame, "16");
  size_t count = 0;
  while (frame.coarser() == 0 && count < shots_.size()) {
    fire(frame, count, count + kStep);
    count += kStep;
  }
  const uint64_t coarser = frame.coarser(), givenUp = frame.givenUp();
  ASSERT_GT(coarser, 0u);
  ASSERT_EQ(givenUp, 0u);
  const Painting coarse = look(frame, count);
  set(frame, "1000");
  frame.setRays(nullptr);
  frame.render(kBefore, kAcross / 4, kDown / 4, std::span(shots_).first(count),
               {"paint", "paint_owner"});
  EXPECT_GE(frame.waiting(), coarser) << "hidden shots wait too";
  EXPECT_EQ(frame.coarser(), coarser);
  EXPECT_EQ((Painting{frame.read("paint").pixels, frame.read("paint_owner").pixels}), coarse);
  frame.setRays(&rays_);
  const Painting exact = look(frame, count);
  EXPECT_EQ(frame.coarser(), 0u);
  PaintFrame fresh(device(), scene_);
  start(fresh, "1000");
  EXPECT_EQ(look(fresh, count), exact);
}

}  // namespace
}  // namespace grisaille::tests
