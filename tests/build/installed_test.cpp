// SPDX-License-Identifier: MIT
// The installation has everything that an author needs and may be moved: effects are built and run
// with the sources and the build folder hidden.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "core/image/image.h"
#include "tests/build/installation.h"
#include "tests/build/session.h"

namespace grisaille::tests {
namespace {

TEST_F(Installed, NamesNeitherTheSourcesNorTheBuild) {
  size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(prefix())) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const std::string content = readFile(entry.path());
    for (const char* folder : {SOURCE_FOLDER, BUILD_FOLDER}) {
      EXPECT_EQ(content.find(folder), std::string::npos) << entry.path() << " names " << folder;
    }
  }
  EXPECT_GT(files, 20u);
}

// Runs the tutorial from the first command to the last and compares its pictures with the manual's.
TEST_F(Installed, TutorialRunsAndItsPicturesAreThose) {
  const Outcome outcome =
      session("tutorial", sessionOf(fs::path(SOURCE_FOLDER) / "docs/manual/write_an_effect.md"));
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  size_t pictures = 0;
  for (const auto& entry : fs::directory_iterator(workOf("tutorial") / "outline")) {
    const std::string name = entry.path().filename();
    if (entry.path().extension() != ".png") continue;
    ++pictures;
    const fs::path shown = fs::path(SOURCE_FOLDER) / "docs/pictures" / name;
    ASSERT_TRUE(fs::exists(shown)) << shown;
    // Only rounding differences between drivers are allowed.
    EXPECT_LT(image::shareOver(image::read(entry.path()), image::read(shown), 8.0 / 255), 0.002)
        << name;
  }
  EXPECT_EQ(pictures, 4u);
}

// The tutorial's effect draws the same lines for an orthographic camera as for a perspective one
// 1,000 m behind it, which sees the same.
TEST_F(Installed, TutorialHoldsForOrthographicCameras) {
  const fs::path outline = workOf("tutorial") / "outline";
  if (!fs::exists(outline)) GTEST_SKIP() << "the tutorial did not run";
  const std::string script =
      "cd outline\nexport GRISAILLE_EFFECT_PATH=\"$PWD/build/lib/grisaille/effects\"\n"
      "grisaille render --effects outline --size 320x180 --write visibility=parallel.exr --camera '"
      R"({"eye": [-6.5, 1.75, 1.9], "target": [2.6, 2.35, -1.2], "orthographic_height": 6, "far": 60})"
      "'\n"
      "grisaille render --effects outline --size 320x180 --write visibility=afar.exr --camera '"
      R"({"eye": [-951.24414, -60.54082, 323.73592], "target": [2.6, 2.35, -1.2], "fovy_degrees": 0.3437736, "near": 1000.01})"
      "'\n";
  const Outcome outcome = session("tutorial", script);
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const image::Image parallel = image::read(outline / "parallel.exr"),
                     afar = image::read(outline / "afar.exr");
  const auto lines = [](const image::Image& picture) {
    return std::ranges::count_if(picture.pixels, [](float v) { return v < 0.5f; });
  };
  EXPECT_GT(lines(afar), 500);
  EXPECT_NEAR(static_cast<double>(lines(parallel)) / static_cast<double>(lines(afar)), 1, 0.05)
      << lines(parallel) << " and " << lines(afar);
}

// A project in C, with another compiler than the program's, and all commands of its README.
TEST_F(Installed, ProjectInCBuiltByClangRuns) {
  if (runShell("command -v clang", ".").status != 0) GTEST_SKIP() << "clang is not installed";
  ASSERT_EQ(session("c", "grisaille new-effect edge_lines mine --language c").status, 0);
  const std::string readme = sessionOf(workOf("c") / "mine/README.md");
  // Limits windows to two frames; a reader would close them.
  const Outcome outcome =
      session("c",
              "cd mine; export CC=clang CXX=clang++\n"
              "grisaille() { command grisaille \"$@\" $([[ $1 == view ]] && echo --frames 2); }\n" +
                  readme);
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("edge_lines 0.1.0: Darkens distant surfaces"), std::string::npos);
  EXPECT_NE(outcome.out.find("reach          8          0.001 ... 1000000 m"), std::string::npos)
      << outcome.out;
  const fs::path mine = workOf("c") / "mine";
  EXPECT_NE(readFile(mine / "build/CMakeCache.txt").find("/clang"), std::string::npos);
  // Both backends have drawn the same picture.
  const image::Image opengl = image::read(mine / "opengl.png");
  EXPECT_LT(image::compare(opengl, image::read(mine / "vulkan.png")).largest, 2.5 / 255);
  EXPECT_GT(image::compare(opengl, image::read(mine / "both.png")).rmse, 0.01);
}

TEST_F(Installed, PackageHoldsAllAndNamesWhatItNeeds) {
  if (runShell("command -v dpkg-shlibdeps", ".").status != 0) {
    GTEST_SKIP() << "dpkg-dev is not installed";
  }
  const fs::path work = workOf("package");
  fs::create_directories(work);
  const Outcome made = runShell(std::string("cd ") + BUILD_FOLDER + " && " + CPACK + " -B " +
                                    work.string() + " && cd " + work.string() +
                                    " && dpkg-deb -x *.deb root && dpkg-deb -f *.deb Depends",
                                work);
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  // Distribution releases differ in the versions in library names.
  for (const char* library :
       {"libc6 ", "libembree[34]", "libglfw3 ", "libopenimageio2\\.[0-9]",
        "libspirv-cross-c-shared0", "libdraco[0-9]+", "libmeshoptimizer[0-9]+d?",
        "libtinygltf[0-9.]*d?", "libegl1 \\| libvulkan1"}) {
    EXPECT_TRUE(std::regex_search(made.out, std::regex(library)))
        << library << " not in " << made.out;
  }
  const Outcome drawn = runShell(
      "root/usr/bin/grisaille render --size 64x36 --write color=from_package.png && "
      "root/usr/bin/grisaille effects",
      work);
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find((work / "root/usr/lib/grisaille/effects/ssao.so").string()),
            std::string::npos)
      << drawn.out;
  EXPECT_EQ(image::read(work / "from_package.png").width, 64u);
}

}  // namespace
}  // namespace grisaille::tests
