// SPDX-License-Identifier: MIT
// Shots on the command line: fired, saved, loaded, counted, refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class Paint : public ::testing::Test {
 protected:
  Outcome render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "--size", "160x90", "--effects", "ssao,sspm",
                                         "--set", "sspm.paint_range=1", "--write", "paint=p.exr"});
    return runProgram(arguments, folder_.path());
  }
  void expectError(const std::vector<std::string>& arguments, int number,
                   const std::string& mention = "") {
    const Outcome outcome = render(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_EQ(outcome.err.rfind("error E" + std::to_string(number) + ": ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << mention << " not in " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& file : folder_.files()) EXPECT_NE(file, "p.exr");
  }
  TemporaryFolder folder_;
};

TEST_F(Paint, FiredShotsAreSavedAndLoadedToTheSamePicture) {
  const Outcome fired = render({"--fire", "40,45,#ff0000", "--fire", "110,40,#00ff00", "--save",
                                "sspm=s.json", "--save", "sspm=s.shots", "--coverage", "-"});
  ASSERT_EQ(fired.status, 0) << fired.err;
  const std::vector<float> picture = image::read(folder_ / "p.exr").pixels;
  EXPECT_GT(*std::max_element(picture.begin(), picture.end()), 0.9f);
  for (const char* file : {"s.json", "s.shots"}) {
    const Outcome loaded = render({"--load", std::string("sspm=") + file, "--coverage", "-"});
    ASSERT_EQ(loaded.status, 0) << loaded.err;
    EXPECT_EQ(image::read(folder_ / "p.exr").pixels, picture) << file;
    EXPECT_EQ(loaded.out, fired.out) << file;
  }
  // What is fired comes after what is loaded: it wins.
  const Outcome over =
      render({"--load", "sspm=s.json", "--fire", "40,45,#0000ff", "--coverage", "c.csv"});
  ASSERT_EQ(over.status, 0) << over.err;
  const std::string shares = readFile(folder_ / "c.csv");
  EXPECT_NE(shares.find("#0000ff,0."), std::string::npos) << shares;
  EXPECT_EQ(shares.find("#ff0000,0."), std::string::npos) << shares;
}

TEST_F(Paint, SharesAddUpToTheWhole) {
  const Outcome outcome =
      render({"--fire", "40,45,#ff0000", "--fire", "110,40,#00ff00", "--coverage", "-"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "color,share");
  double sum = 0;
  size_t colors = 0;
  while (std::getline(lines, line)) {
    sum += std::stod(line.substr(line.find(',') + 1));
    ++colors;
  }
  EXPECT_EQ(colors, 3u);
  EXPECT_NEAR(sum, 1, 1e-5);
}

// What is asked for is drawn, and nothing beside it: full resolution has one pass, as ever.
TEST_F(Paint, PassesAreThoseOfTheResolution) {
  const std::vector<std::string> one = {"surface"}, two = {"samples", "upsample"},
                                 three = {"samples", "upsample", "rest"};
  for (const auto& [resolution, refine, passes] : {std::tuple("full", "rims", one),
                                                   {"half", "rims", three},
                                                   {"half", "edges", three},
                                                   {"quarter", "rims", three},
                                                   {"quarter", "nothing", two}}) {
    const Outcome outcome = render({"--fire", "40,45,#ff0000", "--timings", "t.csv", "--set",
                                    std::string("sspm.resolution=") + resolution, "--set",
                                    std::string("sspm.refine=") + refine});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::istringstream lines(readFile(folder_ / "t.csv"));
    std::vector<std::string> own;
    for (std::string line; std::getline(lines, line);) {
      const size_t effect = line.find(",sspm,");
      if (effect == std::string::npos) continue;
      const size_t pass = effect + 6;
      own.push_back(line.substr(pass, line.find(',', pass) - pass));
    }
    EXPECT_EQ(own, passes) << resolution << " " << refine;
  }
}

TEST_F(Paint, ShotsPaintThePixelThatTheyAreFiredThrough) {
  const Outcome outcome =
      render({"--fire", "40,45,#ff0000", "--write", "paint_coverage=k.exr", "--check"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(image::read(folder_ / "k.exr").at(40, 45), 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("wait"), std::string::npos) << outcome.err;
}

TEST_F(Paint, WhatIsWrongIsRefusedByName) {
  expectError({"--fire", "1,2"}, 5101, "X,Y,#rrggbb");
  expectError({"--fire", "1,2,red"}, 5101, "red");
  expectError({"--fire", "160,2,#ffffff"}, 5101, "160x90");
  expectError({"--load", "sspm"}, 5101, "EFFECT=FILE");
  expectError({"--load", "ssao=s.json"}, 3205, "ssao");
  expectError({"--load", "spmm=s.json"}, 3201, "sspm");
  expectError({"--load", "sspm=missing.json"}, 3411, "missing.json");
  expectError({"--load", "sspm=" + folder_.write("a.json", "{\"version\": 1,\n \"shots\": [}")},
              3412, "a.json:2:");
  expectError({"--load", "sspm=" + folder_.write("b.json", "{\"version\": 9, \"shots\": []}")},
              3413, "9");
  const std::string shot =
      R"({"version": 1, "shots": [{"origin": [0,1,0], "direction": [0,0,0], "color": [1,0,0]}]})";
  expectError({"--load", "sspm=" + folder_.write("c.json", shot)}, 3412, "direction");
  expectError({"--fire", "1,1,#ff0000", "--save", "sspm=s.txt"}, 3414, "s.txt");
  expectError({"--timings", "-", "--coverage", "-"}, 5101);
  const Outcome none =
      runProgram({"render", "--size", "16x9", "--fire", "1,1,#ff0000"}, folder_.path());
  EXPECT_EQ(none.err.rfind("error E3205: ", 0), 0u) << none.err;
}

}  // namespace
}  // namespace grisaille::tests
