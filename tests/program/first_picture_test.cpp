// SPDX-License-Identifier: MIT
// The picture that a user sees of a file that is opened without options.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/image/image.h"
#include "tests/program/run.h"
#include "tests/support/scene_files.h"

namespace grisaille::tests {
namespace {

class FirstPicture : public ::testing::TestWithParam<std::string> {
 protected:
  // Checks the file's first picture and appends the share of it that surfaces cover.
  void expectSomething(const std::string& file, std::vector<double>& covered) {
    SCOPED_TRACE(file);
    std::vector<std::string> arguments = {"render",      "--backend", GetParam(),
                                          "--size",      "160x90",    "--write",
                                          "color=c.exr", "--write",   "depth=d.exr"};
    if (!file.empty()) arguments.insert(arguments.begin() + 1, file);
    const Outcome outcome = runProgram(arguments, folder_.path());
    // A file without triangles is an error, not a picture.
    if (outcome.err.rfind("error E2104", 0) == 0) return;
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const image::Image color = image::read(folder_ / "c.exr"),
                       depth = image::read(folder_ / "d.exr");
    const auto seen = std::ranges::count_if(depth.pixels, [](float metres) { return metres > 0; });
    covered.push_back(static_cast<double>(seen) / static_cast<double>(depth.pixels.size()));
    // Shading, or a silhouette on the backdrop: a convex body alone has no occlusion.
    const auto [least, most] = std::ranges::minmax(color.pixels);
    EXPECT_GT(most - least, 0.1f);
  }

  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, FirstPicture, ::testing::Values("opengl", "vulkan"),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(FirstPicture, IsNeverOfOneValue) {
  std::vector<double> covered;
  expectSomething("", covered);  // the atrium
  for (const std::string& file :
       sceneFilesBelow({SOURCE_FOLDER "/studies/scenes", SOURCE_FOLDER "/../shared/models",
                        SOURCE_FOLDER "/../shared/scenes"})) {
    expectSomething(file, covered);
  }
  ASSERT_GE(covered.size(), 2u);
  std::ranges::sort(covered);
  EXPECT_GE(covered[covered.size() / 2], 0.35);
}

}  // namespace
}  // namespace grisaille::tests
