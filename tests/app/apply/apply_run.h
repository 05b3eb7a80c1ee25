// SPDX-License-Identifier: MIT
// Runs `grisaille apply` on pictures by `grisaille render`.
#pragma once

#include <gtest/gtest.h>

#include <sstream>

#include "core/image/image.h"
#include "tests/program/run.h"
#include "tests/support/test_device.h"

namespace grisaille::tests {

inline constexpr const char* kCamera =
    R"({"eye": [-5, 2.6, 1.6], "target": [2, -0.6, -0.9], "fovy_degrees": 50, "near": 0.05})";

class ApplyOnce : public ::testing::Test {
 protected:
  // Runs a command line; @ stands for the camera. `apply` has the radius of `render`, although it
  // would choose another one for the part of the scene that the pictures show.
  Outcome grisaille(const std::string& line) {
    std::istringstream words(line);
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word == "@" ? camera_ : word);
    // Pictures hold nothing beyond their border, nor how thick bodies are.
    if (line.starts_with("apply ")) {
      arguments.insert(arguments.end(), {"--set", "ssao.radius=0.5"});
    } else {
      arguments.insert(arguments.end(),
                       {"--set", "ssao.guard_band=0", "--set", "ssao.backs=assumed"});
    }
    return runProgram(arguments, folder_.path(), environment_);
  }
  void run(const std::string& line) {
    const Outcome outcome = grisaille(line);
    ASSERT_EQ(outcome.status, 0) << line << "\n" << outcome.err;
  }
  void expectError(const std::string& line, const std::string& number, const std::string& mention) {
    const Outcome outcome = grisaille(line);
    EXPECT_NE(outcome.status, 0) << line;
    EXPECT_EQ(outcome.err.rfind("error " + number + ": ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << outcome.err;
  }
  image::Image read(const std::string& name) { return image::read(folder_ / name); }
  void expectSame(const std::string& name, const std::string& expected, double allowed = 0) {
    EXPECT_LE(image::shareOver(read(name), read(expected), 1.0 / 255), allowed)
        << name << " " << image::compare(read(name), read(expected)).largest;
  }
  // Renders a frame and its pictures to ao.exr, depth.exr and normal.exr.
  void render(const std::string& more = "", const std::string& size = "161x91") {
    run("render --camera @ --size " + size +
        " --write ao=ao.exr --write depth=depth.exr --write normal=normal.exr " + more);
  }

  TemporaryFolder folder_;
  std::string camera_ = kCamera;
  std::vector<std::string> environment_;
};

class Apply : public ApplyOnce, public ::testing::WithParamInterface<TestDevice> {
 protected:
  void SetUp() override {
    const std::string missing = whyMissing(GetParam());
    if (!missing.empty()) GTEST_SKIP() << missing;
    environment_ = driverEnvironment(GetParam());
  }
};

}  // namespace grisaille::tests
