// SPDX-License-Identifier: MIT
// A device that runs out of memory, is lost, or is missing.
#include <filesystem>

#include "tests/program/faulty_run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class DeviceFaults : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (render({}).status != 0) GTEST_SKIP() << GetParam() << " is not present";
    folder_.write("ao.exr", "precious");
  }
  Outcome run(std::vector<std::string> words, const std::string& fault, int after = 0) const {
    words.insert(words.end(), {"--backend", GetParam()});
    return runProgram(words, folder_.path(), faulty(fault, after, folder_.path()));
  }
  Outcome render(const std::vector<std::string>& more, const std::string& fault = "none",
                 int after = 0) const {
    std::vector<std::string> words = {"render",  "--size",   "16x9", "--set", "ssao.kernel_size=2",
                                      "--write", "ao=ao.exr"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words, fault, after);
  }
  void expectKept() const { EXPECT_EQ(readFile(folder_ / "ao.exr"), "precious"); }

  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, DeviceFaults, testing::Values("opengl", "vulkan"),
                         [](const auto& of) { return of.param; });

// At any time: as the device starts, in a frame, or in an effect, which must not be blamed.
TEST_P(DeviceFaults, MemoryThatIsUsedUpIsNamed) {
  for (const int after : {0, 3, 6}) expectEnds(render({}, "out_of_memory", after), 1007);
  expectKept();
}

TEST_P(DeviceFaults, ALostDeviceIsNamed) {
  expectEnds(render({}, "device_lost"), 1006);
  expectEnds(render({"--frames", "3"}, "device_lost", 1), 1006);
  // Also under --check.
  expectEnds(render({"--check"}, "device_lost"), 1006);
  expectKept();
}

// A lost device must not decide the cases that are still to come.
TEST_P(DeviceFaults, ALostDeviceLeavesTheTableOfASweep) {
  folder_.write("stability.md", "precious");
  expectEnds(run({"stability", "--only", "near plane", "--quick", "--out", "."}, "device_lost", 3),
             1006);
  EXPECT_EQ(readFile(folder_ / "stability.md"), "precious");
}

TEST(LostDevice, EndsTheCheckOfAnEffectByAFault) {
  const TemporaryFolder folder;
  const std::string effects = fs::path(PROGRAM).parent_path().parent_path() / "lib/grisaille";
  const Outcome outcome = runProgram({"effects", "--verify", effects + "/effects/ssao.so"},
                                     folder.path(), faulty("device_lost", 2, folder.path()));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("ssao: the check did not finish: "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("the process ended"), std::string::npos) << outcome.out;
}

// Both backends run by default. If one is missing, the program says so before it measures anything.
TEST(MissingBackend, IsNamedBeforeAnyWork) {
  const TemporaryFolder folder;
  const Outcome outcome =
      runProgram({"measure", "--sweep", "ssao.kernel_size=2,4", "--size", "16x9", "--samples", "16",
                  "--out", "m"},
                 folder.path(), {"LD_PRELOAD=" HIDE_LIBRARY, "HIDE_LIBRARY=libvulkan.so"});
  expectEnds(outcome, 1001);
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace grisaille::tests
