// SPDX-License-Identifier: MIT
// `grisaille-lab soak`, run as users run it.
#include <gtest/gtest.h>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class SoakRun : public ::testing::Test {
 protected:
  Outcome soak(const std::string& options) const {
    return runShell("grisaille-lab soak --size 320x180 " + options, folder_.path());
  }
  TemporaryFolder folder_;
};

class SoakCommand : public SoakRun, public ::testing::WithParamInterface<const char*> {};

// The times of frames are left out: beside other tests, the machine is too busy for them.
TEST_P(SoakCommand, AMinuteHoldsButForTimes) {
  const Outcome outcome = soak(
      std::string("--minutes 1 --before 1000 --shots 600 --memory 16 --backend ") + GetParam());
  if (outcome.status != 0) {
    EXPECT_EQ(outcome.err.rfind("error E5306: ", 0), 0u) << outcome.err;
  }
  for (const char* part : {"| reload | ", "| resize | ", "| places shots anew | ", "fired ",
                           "memory at the limit: "}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  }
  for (const char* fault : {"fault: memory", "fault: the effect's limit"}) {
    EXPECT_EQ(outcome.out.find(fault), std::string::npos) << outcome.out;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, SoakCommand, ::testing::Values("opengl", "vulkan"),
                         [](const auto& one) { return std::string(one.param); });

TEST_F(SoakRun, AFaultEndsItWithAnError) {
  // Too few shots to reach the limit.
  const Outcome outcome = soak("--minutes 0.05 --before 3 --shots 3 --backend opengl");
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("fault: the effect's limit of memory is not reached"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.err.find("error E5306: "), std::string::npos) << outcome.err;
}

TEST_F(SoakRun, ValuesOutOfRangeAreRefused) {
  for (const char* options :
       {"--minutes 0", "--minutes x", "--shots 0", "--memory 4", "--backend glide", "--size 0x0"}) {
    const Outcome outcome = soak(options);
    EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << options << outcome.out;
    EXPECT_EQ(outcome.err.rfind("error E", 0), 0u) << outcome.err;
  }
}

}  // namespace
}  // namespace grisaille::tests
