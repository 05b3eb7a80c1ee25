// SPDX-License-Identifier: MIT
// Objects on the command line: added, saved, loaded, counted, refused.
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

TEST_F(Paint, AddedShotsAreSavedAndLoadedToTheSamePicture) {
  const Outcome added =
      render({"--add", "sspm=40,45,color=#ff0000", "--add", "sspm=110,40,color=#00ff00", "--save",
              "sspm=s.json", "--coverage", "-"});
  ASSERT_EQ(added.status, 0) << added.err;
  const std::vector<float> picture = image::read(folder_ / "p.exr").pixels;
  EXPECT_GT(*std::max_element(picture.begin(), picture.end()), 0.9f);
  const Outcome loaded =
      render({"--load", "sspm=s.json", "--save", "sspm=t.json", "--coverage", "-"});
  ASSERT_EQ(loaded.status, 0) << loaded.err;
  EXPECT_EQ(image::read(folder_ / "p.exr").pixels, picture);
  EXPECT_EQ(loaded.out, added.out);
  EXPECT_EQ(readFile(folder_ / "t.json"), readFile(folder_ / "s.json"));
  // Added objects come after loaded ones and cover them.
  const Outcome over =
      render({"--load", "sspm=s.json", "--add", "sspm=40,45,color=#0000ff", "--coverage", "c.csv"});
  ASSERT_EQ(over.status, 0) << over.err;
  const std::string shares = readFile(folder_ / "c.csv");
  EXPECT_NE(shares.find("#0000ff,0."), std::string::npos) << shares;
  EXPECT_EQ(shares.find("#ff0000,0."), std::string::npos) << shares;
}

// Either placed at a pixel, with fields that override those set by placing, or as an object of a
// file.
TEST_F(Paint, AnObjectIsAddedInEitherForm) {
  const Outcome fields =
      render({"--add", "sspm=40,45,origin=0.5:2:3,direction=0:-1:-4,color=#ffffff,range=0.5",
              "--save", "sspm=fields.json"});
  ASSERT_EQ(fields.status, 0) << fields.err;
  const Outcome json =
      render({"--add",
              R"(sspm={"origin": [0.5, 2, 3], "direction": [0, -1, -4], "color": [1, 1, 1], )"
              R"("range": 0.5})",
              "--save", "sspm=json.json"});
  ASSERT_EQ(json.status, 0) << json.err;
  EXPECT_EQ(readFile(folder_ / "fields.json"), readFile(folder_ / "json.json"));
  // Without `color`, the table's default applies.
  ASSERT_EQ(render({"--add", "sspm=40,45"}).status, 0);
}

TEST_F(Paint, SharesAddUpToTheWhole) {
  const Outcome outcome = render({"--add", "sspm=40,45,color=#ff0000", "--add",
                                  "sspm=110,40,color=#00ff00", "--coverage", "-"});
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

// The score is that of the scene, not of the picture: the camera and its size change nothing. On
// floors there is less paint of a shot at a wall.
TEST_F(Paint, TheScoreIsThatOfTheSurface) {
  ASSERT_EQ(render({"--add", "sspm=40,45,color=#ff0000", "--save", "sspm=s.json"}).status, 0);
  const Outcome near = render({"--load", "sspm=s.json", "--coverage", "-"});
  const Outcome far = render({"--load", "sspm=s.json", "--coverage", "-", "--camera",
                              R"({"eye": [0, 3, -2], "target": [1, 3, -4], "fovy_degrees": 60})"});
  ASSERT_EQ(near.status, 0) << near.err;
  ASSERT_EQ(far.status, 0) << far.err;
  EXPECT_EQ(far.out, near.out);
  EXPECT_NE(near.err.find("coverage of "), std::string::npos) << near.err;
  const Outcome floors =
      render({"--load", "sspm=s.json", "--coverage", "-", "--coverage-slope", "30"});
  ASSERT_EQ(floors.status, 0) << floors.err;
  EXPECT_NE(floors.out, near.out);
}

TEST_F(Paint, TheSlopeOfTheScoreIsChecked) {
  expectError({"--coverage-slope", "30"}, 5101, "--coverage");
  expectError({"--coverage", "-", "--coverage-slope", "181"}, 5101, "--coverage-slope");
}

// Only the requested passes run: full resolution has a single pass.
TEST_F(Paint, PassesAreThoseOfTheResolution) {
  const std::vector<std::string> one = {"surface"}, two = {"samples", "upsample"},
                                 three = {"samples", "upsample", "rest"};
  for (const auto& [resolution, refine, passes] : {std::tuple("full", "rims", one),
                                                   {"half", "rims", three},
                                                   {"quarter", "rims", three},
                                                   {"quarter", "nothing", two}}) {
    const Outcome outcome = render({"--add", "sspm=40,45,color=#ff0000", "--timings", "t.csv",
                                    "--set", std::string("sspm.resolution=") + resolution, "--set",
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

TEST_F(Paint, ShotsPaintThePixelThatTheyAreAddedAt) {
  const Outcome outcome =
      render({"--add", "sspm=40,45,color=#ff0000", "--write", "paint_coverage=k.exr", "--check"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(image::read(folder_ / "k.exr").at(40, 45), 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("not drawn"), std::string::npos) << outcome.err;
}

TEST_F(Paint, WhatIsWrongIsRefusedByName) {
  for (const std::string form : {"1,2", "=1,2", "sspm", "sspm=", "sspm=1", "sspm=1,2,red",
                                 "sspm=a,2", "sspm=-1,2", "sspm=1.5,2", "sspm=1,2,"}) {
    expectError({"--add", form}, 5101, "EFFECT=X,Y");
  }
  expectError({"--add", "sspm=160,2"}, 5101, "a pixel from 0 to 159");
  expectError({"--add", "sspm=2,90"}, 5101, "a pixel from 0 to 89");
  expectError({"--add", "sspm=1,2,color=red"}, 3401, "red");
  expectError({"--add", "sspm=1,2,colour=#ffffff"}, 3401, "nearest is color");
  expectError({"--add", "sspm=1,2,range=-1"}, 3401, "range is -1");
  expectError({"--add", "sspm={\"origin\": [0, 1, 0]}"}, 3401, "direction");
  expectError({"--add", "sspm={"}, 3401);
  expectError({"--add", "ssao=1,2"}, 3205, "ssao");
  expectError({"--add", "spmm=1,2"}, 3201, "sspm");
  expectError({"--load", "sspm"}, 5101, "EFFECT=FILE");
  expectError({"--load", "ssao=s.json"}, 3205, "ssao");
  expectError({"--load", "spmm=s.json"}, 3201, "sspm");
  expectError({"--load", "sspm=missing.json"}, 3411, "missing.json");
  expectError({"--load", "sspm=" + folder_.write("a.json", "{\"version\": 1,\n \"shots\": [}")},
              3412, "line 2");
  expectError({"--load", "sspm=" + folder_.write("b.json", "{\"version\": 9, \"shots\": []}")},
              3413, "9");
  const std::string shot =
      R"({"version": 1, "shots": [{"origin": [0,1,0], "direction": [0,0,0], "color": [1,0,0]}]})";
  expectError({"--load", "sspm=" + folder_.write("c.json", shot)}, 3412, "shots[0].direction");
  expectError({"--add", "sspm=1,1", "--save", "sspm=s.txt"}, 3414, "s.txt");
  expectError({"--add", "sspm=1,1", "--save", "sspm=s.shots"}, 3414, "s.shots");
  expectError({"--timings", "-", "--coverage", "-"}, 5101);
  const Outcome none = runProgram(
      {"render", "--size", "16x9", "--effects", "ssao", "--add", "sspm=1,1"}, folder_.path());
  EXPECT_EQ(none.err.rfind("error E3201: ", 0), 0u) << none.err;
}

}  // namespace
}  // namespace grisaille::tests
