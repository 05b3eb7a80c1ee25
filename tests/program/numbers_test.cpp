// SPDX-License-Identifier: MIT
// Numbers on the command line: errors state allowed ranges in few digits and count as usage errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class Numbers : public testing::Test {
 protected:
  void expectUsage(const std::string& words, const std::string& mention) const {
    const Outcome outcome = runShell(programOf(words) + " " + words, folder_.path());
    EXPECT_EQ(outcome.status, 2) << words << outcome.err;
    EXPECT_EQ(outcome.err.rfind("error E5101: ", 0), 0u) << words << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << words << ": " << outcome.err;
    EXPECT_FALSE(std::regex_search(outcome.err, std::regex("[0-9]{9}"))) << outcome.err;
  }
  TemporaryFolder folder_;
};

TEST_F(Numbers, RangesAreToldInFewDigits) {
  const std::string tune = "tune --out t.toml --max-error ", claims = "claims c.toml --out d ";
  expectUsage(tune + "-1", "--max-error: '-1' is not a number over 0");
  expectUsage(tune + "0", "--max-error: '0' is not a number over 0");
  expectUsage(tune + "many", "--max-error: 'many' is not a number over 0");
  expectUsage("tune --out t.toml --budget-ms -3", "--budget-ms: '-3' is not a number over 0");
  expectUsage("apply --depth d.exr --near 0 --write ao=a.exr",
              "--near: '0' is not a number over 0");
  expectUsage("apply --depth d.exr --far -1 --write ao=a.exr",
              "--far: '-1' is not a number over 0");
  expectUsage(claims + "--scale 9", "--scale: '9' is not a number from 0.05 to 4");
  expectUsage("measure --out d --radius 1e9",
              "--radius: '1e9' is not a number from 1e-06 to 1e+06");
  expectUsage("render --frames 0", "--frames: '0' is not a whole number from 1 to 1000000");
  expectUsage("render --frames 1.5", "--frames: '1.5' is not a whole number from 1 to 1000000");
  expectUsage("truth --write ao=a.exr --radius 1e9", "--radius is 1e+09");
}

TEST_F(Numbers, NotANumberIsSaidToBeNone) {
  for (const std::string nan : {"nan", "NaN", "-nan", "inf", "-inf"}) {
    expectUsage("tune --out t.toml --max-error " + nan, "--max-error: '" + nan + "' is not a");
    expectUsage("tune --out t.toml --budget-ms " + nan, "--budget-ms: '" + nan + "' is not a");
    expectUsage("measure --out d --radius " + nan, "--radius: '" + nan + "' is not a");
    expectUsage("measure --out d --samples " + nan, "--samples: '" + nan + "' is not a");
    expectUsage("claims c.toml --out d --scale " + nan, "--scale: '" + nan + "' is not a");
    expectUsage("apply --depth d.exr --write ao=a.exr --near " + nan,
                "--near: '" + nan + "' is not a");
    expectUsage("truth --write ao=a.exr --radius " + nan, "--radius");
    expectUsage("truth --write ao=a.exr --error " + nan, "--error");
    expectUsage("truth --write ceiling=a.exr --thickness " + nan, "--thickness");
    expectUsage("render --frames " + nan, "--frames: '" + nan + "' is not a");
  }
  expectUsage("apply --depth d.exr --write ao=a.exr --far nan", "--far: 'nan' is not a");
  expectUsage("view --compare-truth --truth-radius nan", "--truth-radius");
}

TEST_F(Numbers, HelpNamesRangesInFewDigits) {
  for (const std::string command :
       {"render", "apply", "view", "effects", "new-effect", "backends", "truth", "measure", "tune",
        "claims", "stability", "scene", "completion"}) {
    const std::string help = runProgram({command, "--help"}, folder_.path()).out;
    EXPECT_FALSE(std::regex_search(help, std::regex("[0-9]{9}"))) << help;
  }
  const std::string help = runProgram({"measure", "--help"}, folder_.path()).out;
  EXPECT_NE(help.find("--radius FLOAT:1e-06 to 1e+06"), std::string::npos) << help;
}

// The status is the same whether the command line's parser or a command finds the mistake.
TEST_F(Numbers, EveryMistakeOfUsageHasTheStatus2) {
  for (const std::string words :
       {"render --size 16", "render --write color", "render --set radius",
        "render --timings - --coverage -", "render --preset ssao", "tune --out t.toml",
        "measure --out d --shard 3/2", "measure --out d --sweep ssao.radius",
        "stability --out d --only nothing", "truth --write ao=a.exr --error -1",
        "apply --depth d.####.exr --frames x --write ao=a.####.exr", "view --size 1"}) {
    expectUsage(words, "");
  }
}

TEST_F(Numbers, MeasureTakesItsSceneAsOthersDo) {
  for (const std::string command : {"render", "truth", "tune", "measure", "scene", "view"}) {
    const std::string help = runProgram({command, "--help"}, folder_.path()).out;
    EXPECT_NE(help.find("[scene]"), std::string::npos) << help;
    EXPECT_EQ(help.find("--scene "), std::string::npos) << help;
  }
  const Outcome scene = runShell("grisaille scene --write a.glb", folder_.path());
  ASSERT_EQ(scene.status, 0) << scene.err;
  for (const std::string words : {"a.glb --effects ssao", "--effects ssao a.glb"}) {
    const Outcome outcome = runShell(
        "XDG_CACHE_HOME=$PWD grisaille measure " + words +
            " --size 16x16 --samples 16 --rounds 1 --backend opengl --sweep ssao.kernel_size=2 "
            "--out s",
        folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  EXPECT_NE(readFile(folder_ / "s/results.json").find("render a.glb"), std::string::npos);
}

}  // namespace
}  // namespace grisaille::tests
