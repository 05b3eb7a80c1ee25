// SPDX-License-Identifier: MIT
// `cmake -S . -B build` on machines without some libraries.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class Configure : public ::testing::Test {
 protected:
  // Configures with these libraries hidden from CMake.
  Outcome configure(const std::vector<std::string>& hidden, const std::string& options,
                    const std::string& environment = "") const {
    std::string command =
        environment + " '" + CMAKE + "' -S '" + SOURCE_FOLDER + "' -B build " + options;
    for (const std::string& name : hidden)
      command += " -DCMAKE_DISABLE_FIND_PACKAGE_" + name + "=ON";
    return runShell(command + " 2>&1", folder_.path());
  }

  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(Configure, NamesAllThatIsMissingByDebiansPackages) {
  const Outcome outcome = configure({"fmt", "TinyGLTF", "embree", "glfw3"}, "");
  EXPECT_NE(outcome.status, 0);
  for (const char* package : {"libfmt-dev", "libtinygltf-dev", "libembree-dev", "libglfw3-dev"}) {
    EXPECT_NE(outcome.out.find(package), std::string::npos) << package << ": " << outcome.out;
  }
  EXPECT_EQ(outcome.out.find("libepoxy-dev"), std::string::npos) << outcome.out;
}

// SPIRV-Cross is also found without pkg-config.
TEST_F(Configure, NamesModulesThatPkgConfigLacks) {
  const Outcome outcome = configure({"spirv_cross_c"}, "", "PKG_CONFIG_LIBDIR=/nonexistent");
  EXPECT_NE(outcome.status, 0);
  for (const char* package :
       {"libepoxy-dev", "libopenimageio-dev", "libtomlplusplus-dev", "libspirv-cross-c-shared-dev",
        "libimgui-dev", "libx11-dev", "libxi-dev"}) {
    EXPECT_NE(outcome.out.find(package), std::string::npos) << package << ": " << outcome.out;
  }
}

TEST_F(Configure, PartsCanBeLeftOut) {
  const Outcome outcome =
      configure({"embree", "glfw3", "GTest"}, "-DGRISAILLE_VIEWER=OFF -DGRISAILLE_TRUTH=OFF");
  EXPECT_EQ(outcome.status, 0) << outcome.out;
}

// What packages of the library alone need.
TEST_F(Configure, TheLibraryAloneNeedsFewLibraries) {
  const std::vector<std::string> others = {"embree",   "glfw3", "GTest",         "CLI11",
                                           "TinyGLTF", "draco", "meshoptimizer", "TBB"};
  for (const char* kind : {"ON", "OFF"}) {
    const Outcome outcome =
        configure(others, std::string("-DGRISAILLE_PROGRAMS=OFF -DBUILD_SHARED_LIBS=") + kind);
    EXPECT_EQ(outcome.status, 0) << outcome.out;
  }
  EXPECT_NE(configure(others, "-DGRISAILLE_PROGRAMS=ON").status, 0);
}

TEST_F(Configure, TestsNeedAllParts) {
  const Outcome outcome = configure({}, "-DGRISAILLE_TESTS=ON -DGRISAILLE_VIEWER=OFF");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.out.find("GRISAILLE_TESTS needs GRISAILLE_PROGRAMS,"), std::string::npos)
      << outcome.out;
}

// Users who build with plain CMake may have compilers that the project is not tested with.
TEST_F(Configure, AWarningStopsDevelopersAlone) {
  ASSERT_EQ(configure({}, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON").status, 0);
  EXPECT_EQ(runShell("grep -c Werror build/compile_commands.json", folder()).out, "0\n");
  ASSERT_EQ(configure({}, "-DGRISAILLE_WARNINGS_AS_ERRORS=ON").status, 0);
  EXPECT_NE(runShell("grep -c Werror build/compile_commands.json", folder()).out, "0\n");
}

}  // namespace
}  // namespace grisaille::tests
