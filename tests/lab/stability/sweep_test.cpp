// SPDX-License-Identifier: MIT
// A part of the sweep, on every backend, with the checking layer. `grisaille-lab stability` runs
// the whole sweep.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lab/stability/comparison.h"
#include "lab/stability/movement.h"
#include "lab/stability/runner.h"
#include "tests/support/devices.h"

namespace grisaille::tests {
namespace {

using namespace lab::stability;

// The extreme cases of every group, at small sizes. The system's two devices take turns: each case
// runs on one of them here, and on both in `./dev stability`.
std::vector<Case> quickCases(const TestDevice& device) {
  std::vector<Case> cases = sweepCases(8, 1);
  std::erase_if(cases, [](const Case& one) { return !one.quick; });
  if (!device.driver.empty()) return cases;
  size_t index = device.backend == "opengl" ? 0 : 1;
  std::erase_if(cases, [&](const Case&) { return index++ % 2 != 0; });
  return cases;
}

TEST(Sweep, HasEveryKindOfCase) {
  const std::vector<Case> cases = sweepCases(60, 1);
  EXPECT_GE(cases.size(), 200u);
  std::set<std::string> titles, groups, keys, known;
  for (const Edge& edge : edges()) known.insert(edge.key);
  for (const Case& one : cases) {
    EXPECT_TRUE(titles.insert(one.title()).second) << one.title() << " occurs twice";
    EXPECT_TRUE(keys.insert(keyOf(one)).second) << one.title() << " equals another case";
    EXPECT_TRUE(one.edge.empty() || known.contains(one.edge)) << one.edge;
    EXPECT_NO_THROW(scene::validate(one.camera)) << one.title();
    groups.insert(one.group);
  }
  for (const char* group :
       {"near plane", "field of view", "orthographic", "camera far from the world's origin",
        "near a wall", "scene's scale", "plane", "right angle", "size", "kernel", "radius, m",
        "bias, m", "blur larger than the picture, px", "blur along edges, px", "odd scene",
        "odd depths", "paint range, m", "shot", "at random"}) {
    EXPECT_TRUE(groups.contains(group)) << group;
  }
}

TEST(Sweep, RandomCasesAreTheSeedsOwn) {
  const std::vector<Case> one = sweepCases(5, 7), again = sweepCases(5, 7),
                          other = sweepCases(5, 8);
  EXPECT_EQ(keyOf(one.back()), keyOf(again.back()));
  EXPECT_NE(keyOf(one.back()), keyOf(other.back()));
}

class SweepTest : public BackendTest {
 protected:
  SweepTest() { registry_.scan(EFFECTS_FOLDER); }
  effect::Registry registry_;
};
GRISAILLE_ON_EVERY_DEVICE(SweepTest);

// Cases in which more pixels than usual may differ from the oracle on drivers that are not the
// system's: what share of pixels, and why.
struct Excuse {
  const char* title;
  double share;
  bool snaps;  // only on coarse rasterisers, since depth lies off its surface
};
// Snapping moves places some millimetres off their surface in small pictures and far away.
// `surface` mode treats a place as seen by a muzzle within 2 % of the paint's range, 5 mm by
// default. Slices have 32 sectors: a tap on a border between two rounds to either, a step of 1/32.
constexpr Excuse kExcuses[] = {
    {"near a wall: 1 mm, paint on surfaces", 0.01, true},
    {"size: 3x3, paint on surfaces", 0.25, true},
    {"odd scene: wires, paint on surfaces", 0.2, true},
    {"odd scene: room, normals turned away, slices, raw", 0.002, false},
    {"odd scene: room, normals turned away, slices, backs", 0.002, false}};

// Removes excused faults: differences at a smaller share of pixels than the excuse allows.
void excuse(const Case& one, bool coarse, Result& result) {
  for (const Excuse& other : kExcuses) {
    if (one.title() != other.title || (other.snaps && !coarse)) continue;
    double& share = result.backends[0].oracle.shareOver;
    share = share <= other.share ? 0 : share;
  }
}

TEST_P(SweepTest, QuickCasesHold) {
  const bool systems = GetParam().driver.empty(), coarse = snapping().isCoarse();
  gpu::Device* const devices[] = {&device()};
  Runner runner(registry_, devices);
  size_t touched = 0, count = 0;
  for (const Case& one : quickCases(GetParam())) {
    Result result = runner.run(one);
    if (!systems) excuse(one, coarse, result);
    for (const std::string& fault : faultsOf(one, result))
      ADD_FAILURE() << one.title() << ": " << fault;
    touched += result.backends[0].touched > 0 ? 1 : 0;
    ++count;
  }
  // Most cases show occlusion or paint; planes and skies stay open.
  EXPECT_GT(touched, count * 3 / 5);
}

// Results are bitwise equal across runs and instances, independent of draws in between.
TEST_P(SweepTest, TheSameValuesMakeTheSameBits) {
  gpu::Device* const devices[] = {&device()};
  std::vector<Case> cases = sweepCases(5, 3);
  std::erase_if(
      cases, [](const Case& one) { return one.group != "at random" && one.group != "guard band"; });
  std::vector<uint64_t> bits;
  {
    Runner runner(registry_, devices);
    for (const Case& one : cases) bits.push_back(runner.run(one).backends[0].bits);
    for (size_t i = cases.size(); i-- > 0;) {
      EXPECT_EQ(runner.run(cases[i]).backends[0].bits, bits[i]) << cases[i].title();
    }
  }
  EXPECT_GT(std::set(bits.begin(), bits.end()).size(), cases.size() * 2 / 3);
  Runner another(registry_, devices);
  for (size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(another.run(cases[i]).backends[0].bits, bits[i]) << cases[i].title();
  }
}

TEST_P(SweepTest, PlanesAreSteadyUnderAMovingCamera) {
  gpu::Device* const devices[] = {&device()};
  Runner runner(registry_, devices);
  for (MovementRow& row : movementRows(true)) {
    measureMovement(runner, row);
    for (const std::string& fault : faultsOf(row)) ADD_FAILURE() << fault;
    ASSERT_EQ(row.now.size(), 1u);
    // Far away, planes need more than 1 cm of bias alone; otherwise this test could not fail.
    EXPECT_EQ(row.safeBias > 0.01, row.distance == 1000) << row.safeBias;
    row.now[0].flicker[1] = 2 * kMostFlicker;
    row.now[0].leastOpen = 0.9;
    EXPECT_EQ(faultsOf(row).size(), 2u);
  }
}

// Wrong results are detected: here the case claims that a right angle is a plane.
TEST_P(SweepTest, AWrongPictureIsAFault) {
  gpu::Device* const devices[] = {&device()};
  Runner runner(registry_, devices);
  std::vector<Case> cases = sweepCases(0, 1);
  const auto found = std::ranges::find(cases, "kernel", &Case::group);
  ASSERT_NE(found, cases.end());
  found->open = true;
  const Result result = runner.run(*found);
  ASSERT_EQ(faultsOf(*found, result).size(), 1u);
  EXPECT_NE(faultsOf(*found, result)[0].find("a plane has a visibility"), std::string::npos);
}

// The pictures of the edges mark the pixels that differ: as many as the result counts, also if an
// output has channels that no oracle knows.
TEST_P(SweepTest, TheMapOfDifferencesAgreesWithTheirShare) {
  gpu::Device* const devices[] = {&device()};
  Runner runner(registry_, devices);
  for (const char* variant : {"slices", "open directions"}) {
    const std::vector<Case> cases = sweepCases(0, 1);
    const auto one = std::ranges::find_if(cases, [&](const Case& found) {
      return found.scenery.kind == Scenery::Kind::kNoNormals && found.variant == variant;
    });
    ASSERT_NE(one, cases.end()) << variant;
    const double share = runner.run(*one).backends.at(0).oracle.shareOver;
    const Compared compared = runner.compare(*one);
    EXPECT_DOUBLE_EQ(apartOf(differences(compared.picture, compared.expected)).shareOver, share)
        << one->title();
  }
}

}  // namespace
}  // namespace grisaille::tests
