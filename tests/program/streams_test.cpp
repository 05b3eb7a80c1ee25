// SPDX-License-Identifier: MIT
// With standard streams that are closed or full, the program still ends with its usual status.
#include <filesystem>

#include "core/image/image.h"
#include "tests/program/faulty_run.h"

namespace grisaille::tests {
namespace {

class Streams : public testing::Test {
 protected:
  Outcome run(const std::string& line) const { return runShell(line, folder_.path()); }
  TemporaryFolder folder_;
};

TEST_F(Streams, AClosedStandardErrorKeepsTheStatus) {
  for (const std::string closed : {"2>&-", "<&- 2>&-", "<&- >&- 2>&-", "2>/dev/full"}) {
    if (closed.ends_with("full") && !std::filesystem::exists("/dev/full")) continue;
    EXPECT_EQ(run("grisaille render no_such_scene.glb " + closed).status, 1) << closed;
    EXPECT_EQ(run("grisaille render --frames 0 " + closed).status, 2) << closed;
  }
}

// Otherwise the picture's file would get the closed stream's number and receive the messages.
TEST_F(Streams, ClosedStreamsLeaveOutputsWhole) {
  for (const std::string backend : {"opengl", "vulkan"}) {
    for (const std::string closed : {"2>&-", "<&-", "<&- 2>&-"}) {
      const std::string name = backend + std::to_string(closed.size()) + ".exr";
      const Outcome outcome = run("grisaille render --size 16x9 --backend " + backend +
                                  " --write ao=" + name + " " + closed);
      EXPECT_EQ(outcome.status, 0) << closed << outcome.err;
      EXPECT_EQ(image::read(folder_ / name).width, 16u) << closed;
    }
  }
}

// The output is lost, as on a full disk.
TEST_F(Streams, AClosedStandardOutputIsAnError) {
  for (const std::string words :
       {"effects", "effects --json", "completion", "--help", "render --help", "--version",
        "render --size 1x1 --write depth=d.exr --timings -"}) {
    expectEnds(run("grisaille " + words + " >&-"), 4103, "standard output");
    expectEnds(run("grisaille " + words + " <&- >&-"), 4103, "standard output");
  }
}

}  // namespace
}  // namespace grisaille::tests
