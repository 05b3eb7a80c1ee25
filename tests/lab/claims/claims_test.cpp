// SPDX-License-Identifier: MIT
// `grisaille-lab claims`, run as users run it, on the project's own study at a smaller size.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kStudy = std::string(SOURCE_FOLDER) + "/studies/claims.toml";

class ClaimsTest : public testing::Test {
 protected:
  Outcome claims(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all = {"claims"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return runProgram(all, folder_.path(), {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  }
  TemporaryFolder folder_;
};

// Keys of the study's claims, except claims about time.
std::string untimedClaims() {
  const std::string study = readFile(kStudy), key = "[[claim]]\nkey = \"";
  std::string keys;
  for (size_t at = study.find(key); at != std::string::npos;) {
    const size_t next = study.find(key, at + 1), from = at + key.size();
    if (study.substr(at, next - at).find(".milliseconds") == std::string::npos) {
      keys += (keys.empty() ? "" : ",") + study.substr(from, study.find('"', from) - from);
    }
    at = next;
  }
  return keys;
}

// Claims that hold in the manual's report also hold at another size, with both backends.
TEST_F(ClaimsTest, TheStudyHoldsWhatItReports) {
  const Outcome outcome = claims(
      {kStudy, "--only", untimedClaims(), "--scale", "0.75", "--samples", "32", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(readFile(folder_ / "out/claims.json"));
  ASSERT_EQ(report["backends"].size(), 2u);
  for (const json& backend : report["backends"]) {
    SCOPED_TRACE(backend["backend"]);
    EXPECT_GE(backend["claims"].size(), 9u);
    for (const json& claim : backend["claims"]) {
      for (const json& expectation : claim["expectations"]) {
        EXPECT_FALSE(expectation["timed"]);
        EXPECT_TRUE(expectation["holds"]) << claim["key"] << ": " << expectation;
      }
    }
  }
  // The page embeds its pictures; the Markdown's pictures are files.
  const std::string page = readFile(folder_ / "out/claims.html");
  EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_EQ(page.find("src=\"pictures"), std::string::npos);
  const std::string text = readFile(folder_ / "out/claims.md");
  size_t pictures = 0;
  for (size_t at = 0; (at = text.find("](pictures/", at)) != std::string::npos; ++at, ++pictures) {
    const std::string file = text.substr(at + 2, text.find(')', at) - at - 2);
    EXPECT_TRUE(fs::exists(folder_.path() / "out" / file)) << file;
  }
  EXPECT_GT(pictures, 25u);
}

// The checked-in report matches this study: each claim has its text and its pictures.
TEST(ClaimsReport, TheManualsIsOfThisStudy) {
  const fs::path docs = fs::path(SOURCE_FOLDER) / "docs";
  const std::string report = readFile(docs / "claims.md"), study = readFile(kStudy);
  size_t texts = 0, pictures = 0;
  for (size_t at = 0; (at = study.find("\ntext = \"", at)) != std::string::npos; ++at, ++texts) {
    const std::string text = study.substr(at + 9, study.find("\"\n", at + 9) - at - 9);
    EXPECT_NE(report.find(text), std::string::npos) << text;
  }
  for (size_t at = 0; (at = report.find("](pictures/", at)) != std::string::npos;
       ++at, ++pictures) {
    const std::string file = report.substr(at + 2, report.find(')', at) - at - 2);
    EXPECT_TRUE(fs::exists(docs / file)) << file;
  }
  EXPECT_GT(texts, 5u);
  EXPECT_GT(pictures, 5u);
}

constexpr const char* kSmall = R"([[claim]]
key = "noise"
text = "More sample points, less noise."
source = "A test."
camera = {eye = [-6.5, 1.75, 1.9], target = [2.6, 2.35, -1.2], fovy_degrees = 62}
size = [96, 54]
set = ["ssao.estimator=classic", "ssao.intensity=2", "ssao.blur_size=0"]
runs = [{name = "few", set = ["ssao.kernel_size=4"]}, {name = "many", set = ["ssao.kernel_size=64"]}]
expect = ["few.noise > 1.5 * many.noise"]
[[claim]]
key = "wrong"
text = "Fewer sample points, less noise."
source = "A test."
camera = {eye = [-6.5, 1.75, 1.9], target = [2.6, 2.35, -1.2], fovy_degrees = 62}
size = [96, 54]
set = ["ssao.estimator=classic", "ssao.intensity=2"]
runs = [{name = "few", set = ["ssao.kernel_size=4"]}, {name = "many", set = ["ssao.kernel_size=64"]}]
expect = ["few.rmse < 0.5 * many.rmse"]
)";

// A refuted claim is a result, not a failure.
TEST_F(ClaimsTest, AReadersOwnClaims) {
  const std::string file = folder_.write("mine.toml", kSmall);
  const auto verdicts = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = {file, "--samples", "32", "--backend", "opengl", "--out", "out"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = claims(all);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::vector<std::string> found;
    const json report = json::parse(readFile(folder_ / "out/claims.json"));
    for (const json& claim : report["backends"][0]["claims"]) found.push_back(claim["verdict"]);
    return found;
  };
  EXPECT_EQ(verdicts({}), (std::vector<std::string>{"holds", "does not hold"}));
  EXPECT_EQ(verdicts({"--only", "wrong"}), std::vector<std::string>{"does not hold"});
}

// Pictures of a path show its last frame, which has a history of the frames before.
TEST_F(ClaimsTest, PicturesOfAPathAreOfItsEnd) {
  const std::string file = folder_.write("walk.toml", R"([[claim]]
key = "walk"
text = "A history changes what a walk shows."
source = "A test."
camera = [{eye = [-6.5, 1.75, 1.9], target = [2.6, 2.35, -1.2], fovy_degrees = 62},
          {eye = [-6.4, 1.75, 1.9], target = [2.6, 2.35, -1.2], fovy_degrees = 62}]
frames = 4
size = [96, 54]
runs = [{name = "alone"}, {name = "averaged", set = ["ssao.history=8"]}]
expect = ["averaged.flicker < alone.flicker"]
)");
  const Outcome outcome =
      claims({file, "--samples", "16", "--rounds", "1", "--backend", "opengl", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string folder = folder_ / "out/pictures/claims/";
  const std::string alone = readFile(folder + "walk-alone.png");
  EXPECT_FALSE(alone.empty());
  EXPECT_NE(alone, readFile(folder + "walk-averaged.png"));
}

// An animation runs through the frames of a run; a run that is still shows its end alone. Their
// pictures stand in one row, beside one truth.
TEST_F(ClaimsTest, AnAnimationRunsThroughTheFrames) {
  const std::string scene = std::string(SOURCE_FOLDER) + "/studies/scenes/sliding_box.gltf";
  const std::string file = folder_.write("slide.toml", R"([[claim]]
key = "slide"
text = "A box that slides leaves no ghost."
source = "A test."
scene = ")" + scene + R"("
camera = {eye = [1.0, 1.3, 2.4], target = [0.6, 0.2, -0.2], fovy_degrees = 60}
seconds = [0.4, 0.8]
frames = 17
size = [96, 54]
runs = [{name = "alone"}, {name = "averaged", set = ["ssao.history=16"]}, {name = "end", still = true}]
expect = ["averaged.last_rmse@beside < 1.3 * alone.last_rmse@beside", "end.last_rmse > 0"]
)");
  const Outcome outcome =
      claims({file, "--samples", "32", "--rounds", "1", "--backend", "opengl", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(readFile(folder_ / "out/claims.json"));
  const json& claim = report["backends"][0]["claims"][0];
  EXPECT_EQ(claim["verdict"], "holds") << claim;
  // Without a history, the last frame of the movement is the frame at rest.
  EXPECT_EQ(claim["values"]["alone"]["last_rmse"], claim["values"]["end"]["last_rmse"]);
  EXPECT_NE(claim["values"]["alone"]["last_rmse"], claim["values"]["averaged"]["last_rmse"]);
}

TEST_F(ClaimsTest, AnOptionalSceneThatIsMissingIsLeftOut) {
  const std::string scene = std::string(SOURCE_FOLDER) + "/studies/scenes/corner.gltf";
  const std::string claim = R"([[claim]]
key = "KEY"
text = "A corner is dark."
source = "A test."
scene = "KEY.gltf"
optional = true
camera = {eye = [1.0, 1.3, 2.4], target = [0, 0, 0], fovy_degrees = 60}
size = [32, 32]
runs = [{name = "alone"}]
expect = ["alone.mean < 1"]
)";
  std::string text;
  for (const char* key : {"there", "missing"}) {
    std::string one = claim;
    while (one.find("KEY") != std::string::npos) one.replace(one.find("KEY"), 3, key);
    text += one;
  }
  const std::string file = folder_.write("claims.toml", text);
  const std::vector<std::string> usual = {file,    "--samples", "16",        "--rounds", "1",
                                          "--out", "out",       "--backend", "opengl"};
  const Outcome none = claims(usual);
  EXPECT_EQ(none.status, 2) << none.err;
  const TemporaryFolder scenes;
  fs::copy_file(scene, scenes / "there.gltf");
  std::vector<std::string> with = usual;
  with.insert(with.end(), {"--scenes", scenes.path()});
  const Outcome one = claims(with);
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_NE(one.err.find("left out the claim 'missing'"), std::string::npos) << one.err;
  const json report = json::parse(readFile(folder_ / "out/claims.json"));
  ASSERT_EQ(report["backends"][0]["claims"].size(), 1u);
  EXPECT_EQ(report["backends"][0]["claims"][0]["key"], "there");
}

TEST_F(ClaimsTest, MistakesAreOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& number) {
    const Outcome outcome = claims(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_EQ(outcome.err.rfind("error E" + number + ": ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
    return outcome.err;
  };
  const std::string file = folder_.write("mine.toml", kSmall);
  std::string text = kSmall;
  const std::string broken =
      folder_.write("broken.toml", text.replace(text.find("1.5 *"), 5, "1,5 *"));
  refused({"--out", "out"}, "5101");
  refused({"missing.toml", "--out", "out"}, "5103");
  refused({broken, "--out", "out"}, "5104");
  refused({file, "--out", "out", "--only", "none"}, "5101");
  refused({file, "--out", "out", "--backend", "metal"}, "1002");
  refused({file, "--out", "out", "--scale", "0"}, "5101");
  // A region without pixels.
  text = kSmall;
  const std::string nowhere = folder_.write(
      "nowhere.toml", text.replace(text.find("few.noise >"), 11, "few.noise@far+near >"));
  const std::string line =
      refused({nowhere, "--out", "out", "--backend", "opengl", "--samples", "16"}, "5104");
  EXPECT_NE(line.find("nowhere.toml:1: the region of few.noise@far+near has no pixels"),
            std::string::npos)
      << line;
}

}  // namespace
}  // namespace grisaille::tests
