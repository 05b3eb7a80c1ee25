// SPDX-License-Identifier: MIT
// Study files, valid and invalid: an error names the mistake and its place in one line.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/settings/presets.h"
#include "core/base/error.h"
#include "lab/claims/claims.h"
#include "tests/program/run.h"

namespace grisaille::lab::claims {
namespace {

constexpr const char* kGood = R"([[claim]]
key = "one"
text = "Something is said."
source = "By somebody."
camera = {eye = [0, 1, 3], target = [0, 0, 0], fovy_degrees = 60}
set = ["ssao.radius=1"]
runs = [
  {name = "a", set = ["ssao.bias=0"], against = "b"},
  {name = "b"},
]
expect = [
  "a.rmse > 2 * b.rmse",
  "a.mean@flat < 0.5",
]
picture = {crop = [10, 20, 30, 40], zoom = 3, low = 0.5, high = 0.75}
)";

// The valid file with the first `what` replaced; with `instead` appended if `what` is "".
std::string with(const std::string& what, const std::string& instead) {
  std::string text = kGood;
  if (what.empty()) return text + instead;
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

class ClaimsFileTest : public testing::Test {
 protected:
  ClaimsFileTest() { registry_.scan(EFFECTS_FOLDER); }

  ClaimsFile load(const std::string& text) {
    return loadClaims(folder_.write("study.toml", text), registry_);
  }
  void refused(const std::string& text, ErrorId id, const std::string& place,
               const std::string& word) {
    SCOPED_TRACE(text);
    try {
      load(text);
      ADD_FAILURE() << "no error was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), id) << error.what();
      EXPECT_NE(error.detail().find("study.toml:" + place + ": "), std::string::npos)
          << error.what();
      EXPECT_NE(error.detail().find(word), std::string::npos) << error.what();
      const std::string line = error.what();
      EXPECT_EQ(std::ranges::count(line, '\n'), 0) << line;
    }
  }

  tests::TemporaryFolder folder_;
  effect::Registry registry_;
};

TEST_F(ClaimsFileTest, ReadsAllFields) {
  const ClaimsFile file = load(std::string("title = \"A study\"\n") + kGood);
  EXPECT_EQ(file.title, "A study");
  ASSERT_EQ(file.claims.size(), 1u);
  const Claim& claim = file.claims[0];
  EXPECT_EQ(claim.key, "one");
  EXPECT_EQ(claim.source, "By somebody.");
  EXPECT_EQ(claim.effects, std::vector<std::string>{"ssao"});
  EXPECT_EQ(claim.output, "ssao.ao");
  ASSERT_EQ(claim.runs.size(), 2u);
  EXPECT_EQ(claim.runs[0].against, "b");
  EXPECT_EQ(claim.runs[0].sets, std::vector<std::string>{"ssao.bias=0"});
  EXPECT_EQ(claim.runs[1].cameras.size(), 1u);
  EXPECT_EQ(claim.expectations.size(), 2u);
  EXPECT_EQ(claim.picture.crop, glm::uvec4(10, 20, 30, 40));
  EXPECT_EQ(claim.picture.zoom, 3u);
  const Claim small = scaled(claim, 0.5);
  EXPECT_EQ(small.size, claim.size / 2u);
  EXPECT_EQ(small.picture.crop, glm::uvec4(5, 10, 15, 20));
}

TEST_F(ClaimsFileTest, ValuesOfARunAreOverItsPresetAndTheClaims) {
  std::string text = with("name = \"b\"", "name = \"b\", presets = [\"ssao=fast\"]");
  text.replace(text.find("ssao.radius=1"), 13, "ssao.kernel_size=99\", \"ssao.radius=1");
  text.replace(text.find("ssao.bias=0\"]"), 13,
               "ssao.kernel_size=7\"], presets = [\"ssao=reference\"]");
  const Claim claim = load(text).claims[0];
  const effect::Effect& ssao = registry_.find("ssao");
  const auto inPreset = [&](const char* preset, const char* key) {
    effect::Values values(ssao);
    app::applyPreset(values, app::loadPresets(ssao), preset);
    return values.get(key);
  };
  effect::Selection of[] = {selectionOf(registry_, claim, &claim.runs[0]),
                            selectionOf(registry_, claim, &claim.runs[1])};
  EXPECT_EQ(of[0].values("ssao").get("kernel_size"), 7);
  EXPECT_EQ(of[0].values("ssao").get("resolution"), inPreset("reference", "resolution"));
  EXPECT_EQ(of[1].values("ssao").get("kernel_size"), inPreset("fast", "kernel_size"));
  EXPECT_EQ(of[1].values("ssao").get("radius"), 1);
}

TEST_F(ClaimsFileTest, APathAndShots) {
  std::string text =
      with("camera = {", "camera = [{eye = [4, 1, 3], target = [0, 0, 0], fovy_degrees = 60}, {");
  const size_t end = text.find("60}\nset");
  text.replace(end, 4, "60}]\nframes = 5\neffects = [\"sspm\"]\noutput = \"sspm.paint\"\n");
  text.replace(text.find("set = [\"ssao.radius=1\"]"), 23,
               "shots = [{origin = [0, 1, 2], direction = [0, 0, -2], color = [1, 0, 0]}]");
  text.replace(text.find("ssao.bias=0"), 11, "sspm.r0=2");
  text.replace(text.find("\"b\"},\n]"), 4, "\"b\", shots = 7, noise = \"screen\"}");
  const Claim claim = load(text).claims[0];
  EXPECT_EQ(claim.runs[0].cameras.size(), 5u);
  EXPECT_EQ(claim.runs[0].cameras[2].eye.x, 2);
  EXPECT_EQ(claim.runs[0].shots, 1u);
  EXPECT_EQ(claim.runs[1].shots, 7u);
  EXPECT_TRUE(claim.runs[1].screenNoise);
  EXPECT_EQ(claim.shots[0].direction[2], -1);
}

TEST_F(ClaimsFileTest, AnAnimationAndItsEnd) {
  std::string text = with("set =", "frames = 5\nseconds = [0, 2]\nanimation = 3\nset =");
  text.replace(text.find("\"b\"},\n]"), 4, "\"b\", still = true}");
  const Claim claim = load(text).claims[0];
  EXPECT_EQ(claim.animation, 3u);
  EXPECT_EQ(claim.runs[0].cameras.size(), 5u);
  EXPECT_EQ(claim.runs[0].seconds, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(claim.runs[1].seconds, std::vector<double>(5, 2));
}

// The name of a built-in scene is no file's, and the scene is never missing.
TEST_F(ClaimsFileTest, TakesABuiltInScene) {
  const std::string text = with("set =", "scene = \"leaves\"\noptional = true\nset =");
  const std::string file = folder_.write("study.toml", text);
  const tests::TemporaryFolder scenes;
  for (const std::string& folder : {std::string(), std::string(scenes.path())}) {
    const Claim claim = loadClaims(file, registry_, folder).claims[0];
    EXPECT_EQ(claim.scene, "leaves");
    EXPECT_FALSE(claim.optional);
  }
}

// A scene stands beside the claims file or, if it is not there, in the folder of scenes.
TEST_F(ClaimsFileTest, ScenesOfAnotherFolder) {
  const std::string text =
      with("set =", "scene = \"walker.glb\"\noptional = true\nfloor = true\nset =");
  const std::string file = folder_.write("study.toml", text);
  const tests::TemporaryFolder scenes;
  const auto sceneOf = [&](const std::string& folder) {
    return loadClaims(file, registry_, folder).claims[0].scene;
  };
  EXPECT_EQ(sceneOf(""), folder_ / "walker.glb");
  EXPECT_EQ(sceneOf(scenes.path()), scenes / "walker.glb");
  folder_.write("walker.glb", "");
  EXPECT_EQ(sceneOf(scenes.path()), folder_ / "walker.glb");
  const Claim claim = load(text).claims[0];
  EXPECT_TRUE(claim.optional);
  EXPECT_TRUE(claim.floor);
  EXPECT_FALSE(load(kGood).claims[0].optional);
  EXPECT_FALSE(load(kGood).claims[0].floor);
}

TEST_F(ClaimsFileTest, MistakesAreNamedWithTheirPlace) {
  const ErrorId bad = ErrorId::kSettingsInvalid;
  refused("[[claim]\n", ErrorId::kSettingsUnreadable, "1", "");
  refused("title = 5\n[[claim]]\n", bad, "1", "title");
  refused("claim = 5\n", bad, "1", "claim");
  refused(with("key = \"one\"", "key = \"one/two\""), bad, "2", "key");
  refused(with("key = \"one\"", ""), bad, "1", "key");
  refused(with("text", "txt"), bad, "1", "text");
  refused(with("set =", "sets ="), bad, "6", "nearest is set");
  refused(with("60}", "190}"), ErrorId::kCameraInvalid, "5", "fovy_degrees");
  refused(with("camera =", "frames = 4\ncamera ="), bad, "6", "frames");
  refused(with("ssao.radius=1", "ssao.raduis=1"), ErrorId::kParameterUnknown, "8", "radius");
  refused(with("ssao.radius=1", "ssao.radius"), bad, "8", "ssao.radius");
  refused(with("ssao.bias=0", "ssao.bias=-1"), ErrorId::kParameterRange, "8", "bias");
  refused(with("set =", "effects = [\"none\"]\nset ="), ErrorId::kEffectUnknown, "9", "none");
  refused(with("set =", "output = \"ssao.none\"\nset ="), ErrorId::kOutputUnknown, "9", "none");
  refused(with("set =", "size = [8, 270]\nset ="), bad, "6", "size");
  refused(with("set =", "radius = -1\nset ="), bad, "6", "radius");
  refused(with("set =", "seconds = [0, 1]\nset ="), bad, "5", "frames");
  refused(with("set =", "animation = 1\nset ="), bad, "6", "seconds");
  refused(with("name = \"b\"", "name = \"b\", still = true"), bad, "9", "still");
  refused(with("name = \"b\"", "name = \"b\", still = 1"), bad, "9", "true or false");
  refused(with("name = \"b\"", "name = \"b\", presets = [\"ssao=none\"]"), ErrorId::kPresetUnknown,
          "9", "none");
  refused(with("name = \"b\"", "name = \"b\", presets = [\"none=fast\"]"), ErrorId::kEffectUnknown,
          "9", "none");
  refused(with("a.mean@flat", "a.last_rmse"), bad, "13", "path");
  refused(with("against = \"b\"", "against = \"c\""), bad, "7", "'c'");
  refused(with("name = \"b\"", "name = \"a\""), bad, "9", "two runs");
  refused(with("name = \"b\"", "name = \"b\", shots = 4"), bad, "9", "no shots");
  refused(with("name = \"b\"", "name = \"b\", noise = \"screen\""), bad, "9", "sspm.paint");
  refused(with("2 * b.rmse", "2 * c.rmse"), bad, "12", "'c'");
  refused(with("2 * b.rmse", "2 * b.rms"), bad, "12", "rmse");
  refused(with("a.mean@flat", "a.mean@flatt"), bad, "13", "flat");
  refused(with("a.mean@flat", "a.flicker"), bad, "13", "path");
  refused(with("a.mean@flat", "a.mask_outside"), bad, "13", "shots");
  refused(with("[10, 20, 30, 40]", "[470, 20, 30, 40]"), bad, "15", "crop");
  refused(with("zoom = 3", "zoom = 2.5"), bad, "15", "zoom");
  refused(with("low = 0.5", "low = 2"), bad, "15", "low");
  refused(with("", kGood), bad, "16", "two claims");
  refused(with("", "shots = [{origin = [0, 0, 0], direction = [0, 0, 0], color = [1, 1, 1]}]\n"),
          ErrorId::kObjectField, "16", "direction");
  refused(with("", "shots = \"none.json\"\n"), ErrorId::kObjectFileUnreadable, "16", "none.json");
  EXPECT_THROW(loadClaims(folder_ / "missing.toml", registry_), Error);
}

}  // namespace
}  // namespace grisaille::lab::claims
