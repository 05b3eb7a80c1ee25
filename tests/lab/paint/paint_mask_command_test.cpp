// SPDX-License-Identifier: MIT
// `grisaille-lab paint-mask`, run as users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

constexpr const char* kShots = R"({"version": 1, "shots": [
    {"origin": [0, 2, 3], "direction": [0, -0.3, -1], "color": [1, 0, 0]},
    {"origin": [0, 2, 3], "direction": [0.5, -0.3, -1], "color": [1, 0, 0], "range": 0.5}]})";

class PaintMaskCommand : public ::testing::Test {
 protected:
  Outcome paintMask(const std::string& options) const {
    return runShell("grisaille-lab paint-mask --size 64x36 " + options, folder_.path());
  }
  void expectError(const std::string& options, const std::string& number,
                   const std::string& mention) const {
    SCOPED_TRACE(options);
    const Outcome outcome = paintMask(options);
    EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status;
    EXPECT_EQ(outcome.err.rfind("error E" + number + ": ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(folder_.files(), std::vector<std::string>{"s.json"});
  }

  TemporaryFolder folder_;
};

TEST_F(PaintMaskCommand, TheMaskIsWhereTheMuzzleSees) {
  folder_.write("s.json", kShots);
  const auto painted = [&](const std::string& range) {
    const Outcome outcome = paintMask("--load s.json --paint-range " + range + " --write m.exr");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "wrote m.exr\n");
    const image::Image mask = image::read(folder_ / "m.exr");
    EXPECT_EQ(std::tuple(mask.width, mask.height, mask.channels), std::tuple(64u, 36u, 1u));
    EXPECT_TRUE(std::ranges::all_of(mask.pixels, [](float v) { return v == 0 || v == 1; }));
    return std::ranges::count(mask.pixels, 1.0f);
  };
  const auto narrow = painted("0.3"), wide = painted("2");
  EXPECT_GT(narrow, 0);
  EXPECT_GT(wide, narrow);
  EXPECT_LT(wide, 64 * 36);
}

TEST_F(PaintMaskCommand, MistakesAreOneLine) {
  folder_.write("s.json", kShots);
  expectError("--load s.json --write m.exr", "5101", "shot 0 of s.json");
  expectError("--write m.exr", "5101", "--load");
  expectError("--load s.json --paint-range 1", "5101", "--write");
  for (const char* range : {"-1", "nan", "1e7"}) {
    expectError(std::string("--load s.json --write m.exr --paint-range ") + range, "5101",
                "--paint-range");
  }
  const std::string whole = "--paint-range 1 --write m.exr ";
  expectError(whole + "--load none.json", "3411", "none.json");
  expectError(whole + "--load ''", "5101", "--load");
  expectError(whole + "--load s.json --size 0x9", "5101", "--size");
  expectError(whole + "--load s.json 'no such scene.glb'", "2101", "no such scene.glb");
  expectError(whole + "--load s.json --camera '{}'", "2202", "");
  expectError("--load s.json --paint-range 1 --write no/such/folder/m.exr", "4103", "folder");
}

}  // namespace
}  // namespace grisaille::tests
