// SPDX-License-Identifier: MIT
// An installation, which the tests of a suite share.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "tests/program/run.h"
#include "tests/support/display.h"

namespace grisaille::tests {

namespace fs = std::filesystem;

// Each suite of the program makes the installation, and moves it afterwards.
class Installed : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (SANITIZED) return;
    folder_ = std::make_unique<TemporaryFolder>();
    display_ = std::make_unique<Display>(800, 600);
    const std::string first = *folder_ / "first";
    const Outcome outcome = runShell(
        std::string(CMAKE) + " --install " + BUILD_FOLDER + " --prefix " + first, folder_->path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    fs::rename(first, prefix());
  }
  static void TearDownTestSuite() {
    display_.reset();
    folder_.reset();
  }
  void SetUp() override {
    if (SANITIZED) GTEST_SKIP() << "builds with sanitizers are not installed";
  }

  static fs::path prefix() { return folder_->path() / "moved here"; }

  // Runs a script in a fresh folder. Of the project it sees only the prefix, on the PATH. Empty
  // folders hide the sources and the build where the kernel allows users to mount them.
  static Outcome session(const std::string& name, const std::string& script) {
    const fs::path work = folder_->path() / name;
    const fs::path empty = folder_->path() / "empty";
    fs::create_directories(work);
    fs::create_directories(empty);
    const std::string file = folder_->write(
        name + ".sh", "export PATH=\"" + (prefix() / "bin").string() +
                          ":${PATH#*:}\"\n"
                          "unset GRISAILLE_EFFECT_PATH CMAKE_PREFIX_PATH CMAKE_GENERATOR\n" +
                          script);
    const std::string hide = "for f in '" BUILD_FOLDER "' '" SOURCE_FOLDER "'; do mount --bind '" +
                             empty.string() + "' \"$f\" || exit 1; done; ";
    const bool hidden = runShell("unshare -rm true", work).status == 0;
    if (!hidden) std::puts("the sources stay in sight: no mount namespace can be made");
    return hidden
               ? runShell("unshare -rm bash -c \"" + escaped(hide) + "exec bash '" + file + "'\"",
                          work)
               : runShell("bash '" + file + "'", work);
  }

  static const Display& display() { return *display_; }
  static fs::path workOf(const std::string& name) { return folder_->path() / name; }

 private:
  static std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
      if (c == '"' || c == '$') result += '\\';
      result += c;
    }
    return result;
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::unique_ptr<Display> display_;
};

}  // namespace grisaille::tests
