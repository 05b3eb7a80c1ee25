// SPDX-License-Identifier: MIT
// `grisaille tune` and presets, run as users run them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/scene/scene.h"
#include "tests/program/run.h"
#include "tests/support/scenes.h"

namespace grisaille::tests {
namespace {

using nlohmann::json;

class TuneTest : public testing::TestWithParam<const char*> {
 protected:
  Outcome tune(std::vector<std::string> more) const {
    std::vector<std::string> all = {"tune",      "--backend", GetParam(), "--size",    "96x54",
                                    "--samples", "32",        "--out",    "tuned.toml"};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(all, folder_.path(), {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  }
  // The number that follows a word of the output.
  static double numberAfter(const std::string& text, const std::string& word) {
    const size_t at = text.find(word);
    EXPECT_NE(at, std::string::npos) << word << " is not in " << text;
    return at == std::string::npos ? 0 : std::stod(text.substr(at + word.size()));
  }
  TemporaryFolder folder_;
};

TEST_P(TuneTest, FindsASettingThatErrsNoMoreThanAsked) {
  const Outcome outcome = tune({"--max-error", "0.17", "--evaluations", "16", "--random", "2"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_LE(numberAfter(outcome.out, "\nRMSE "), 0.17);
  EXPECT_NE(outcome.out.find("random 2: RMSE"), std::string::npos) << outcome.out;
  EXPECT_GT(numberAfter(outcome.out, "unseen cameras: RMSE "), 0);
  // The file names its origin and meets the requested error.
  const std::string file = readFile(folder_ / "tuned.toml");
  EXPECT_EQ(file.rfind("# grisaille tune: RMSE 0.17 or less", 0), 0u) << file;
  ASSERT_EQ(runShell("grisaille render --size 96x54 --backend " + std::string(GetParam()) +
                         " --config tuned.toml --write ao=ao.exr",
                     folder_.path())
                .status,
            0);
}

TEST_P(TuneTest, KeepsToABudget) {
  const Outcome outcome = tune({"--budget-ms", "1000", "--vary", "ssao.slices,ssao.intensity",
                                "--evaluations", "12", "--random", "0"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_LE(numberAfter(outcome.out, " at "), 1000);
  // With an ample budget, it takes more slices than the cheap presets.
  EXPECT_GT(numberAfter(outcome.out, " slices="), 1);
  EXPECT_EQ(outcome.out.find("unseen cameras"), std::string::npos);
}

TEST_P(TuneTest, SaysWhatCannotBeHad) {
  const Outcome outcome = tune({"--max-error", "0.0001", "--evaluations", "5"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("E5303"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("nearest: RMSE"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "tuned.toml"));
}

// The setting that the user has is the first start, and the result costs at most as much.
TEST_P(TuneTest, NeverEndsDearerThanItStarted) {
  folder_.write("own.toml",
                "effects = [\"ssao\"]\n[ssao]\nedge_slices = 3\nkernel_size = 18\npower = 1.2\n");
  const Outcome one = tune({"--max-error", "0.9", "--evaluations", "1", "--random", "0", "--config",
                            "own.toml", "--set", "ssao.kernel_size=14", "--json"});
  ASSERT_EQ(one.status, 0) << one.err;
  const json kept = json::parse(one.out.substr(one.out.rfind("{\"evaluations\"")));
  EXPECT_EQ(kept.at("setting").at("ssao.edge_slices"), 3);
  EXPECT_EQ(kept.at("setting").at("ssao.kernel_size"), 14);
  EXPECT_EQ(kept.at("milliseconds"), kept.at("start_milliseconds"));
  const Outcome more = tune({"--max-error", "0.9", "--evaluations", "12", "--random", "0",
                             "--preset", "ssao=fast", "--json"});
  ASSERT_EQ(more.status, 0) << more.err;
  const json found = json::parse(more.out.substr(more.out.rfind("{\"evaluations\"")));
  EXPECT_LE(found.at("milliseconds"), found.at("start_milliseconds"));
}

// Parameters of look keep their values, unless --vary names them.
TEST_P(TuneTest, LeavesTheLookAlone) {
  const Outcome usual = tune({"--budget-ms", "100000", "--evaluations", "8", "--random", "0",
                              "--set", "ssao.power=1.1", "--json"});
  ASSERT_EQ(usual.status, 0) << usual.err;
  const json setting =
      json::parse(usual.out.substr(usual.out.rfind("{\"evaluations\""))).at("setting");
  for (const char* look : {"ssao.intensity", "ssao.power", "ssao.bounce", "ssao.albedo"}) {
    EXPECT_FALSE(setting.contains(look)) << look;
  }
  EXPECT_TRUE(setting.contains("ssao.kernel_size"));
  EXPECT_NE(readFile(folder_ / "tuned.toml").find("power = 1.1"), std::string::npos);
  const Outcome named = tune({"--budget-ms", "100000", "--evaluations", "2", "--random", "0",
                              "--vary", "ssao.power,ssao.kernel_size", "--json"});
  ASSERT_EQ(named.status, 0) << named.err;
  EXPECT_NE(named.out.find("\"ssao.power\":"), std::string::npos) << named.out;
}

// An error of 0 where nothing is occluded would say that every setting is right.
TEST_P(TuneTest, ASceneWithNothingToSeeIsRefused) {
  scene::writeGlb(floorScene(20), folder_ / "plane.glb");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& mention) {
    std::vector<std::string> all = {"plane.glb", "--max-error", "0.1", "--evaluations", "2"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = tune(all);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find("error E5305: " + mention), 0u) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "tuned.toml"));
  };
  refused({"--radius", "0.5", "--set", "ssao.radius=0.5"},
          "no random camera sees occluders within --radius 0.5 m on a third of its pixels");
  refused({"--radius", "0.5", "--set", "ssao.radius=0.5", "--random", "0"},
          "no --camera sees an occluder within --radius 0.5 m");
}

INSTANTIATE_TEST_SUITE_P(Backends, TuneTest, testing::Values("opengl", "vulkan"),
                         [](const auto& test) { return std::string(test.param); });

// The found setting errs less than the defaults, on the cameras of the search.
TEST(Tune, SponzaErrsLess) {
  if (sponza().empty()) GTEST_SKIP() << kNoSponza;
  const TemporaryFolder folder;
  std::string subject = " --size 160x90 --samples 32";
  for (const char* name : {"atrium", "arcade"}) {
    subject += " --camera " + sponzaCamera(name);
  }
  const Outcome usual = runShell("XDG_CACHE_HOME=$PWD grisaille measure " + sponza() +
                                     " --rounds 1 --backend opengl --out usual" + subject,
                                 folder.path());
  ASSERT_EQ(usual.status, 0) << usual.err;
  const json before = json::parse(readFile(folder / "usual/results.json")).at(0);
  const Outcome tuned =
      runShell("XDG_CACHE_HOME=$PWD grisaille tune " + sponza() +
                   " --budget-ms 100000 --evaluations 10 --random 0 --out t.toml" + subject,
               folder.path());
  ASSERT_EQ(tuned.status, 0) << tuned.err;
  const size_t at = tuned.out.find("\nRMSE ");
  ASSERT_NE(at, std::string::npos) << tuned.out;
  const double after = std::stod(tuned.out.substr(at + 6));
  EXPECT_LT(after, 0.99 * before.at("rmse").get<double>()) << tuned.out;
  RecordProperty("before", std::to_string(before.at("rmse").get<double>()));
  RecordProperty("after", std::to_string(after));
}

// The unseen cameras see what can be wrong: none has an RMSE of almost 0.
TEST(Tune, SponzasRandomCamerasSeeErrors) {
  if (sponza().empty()) GTEST_SKIP() << kNoSponza;
  const TemporaryFolder folder;
  for (const std::string seed : {"1", "2", "3"}) {
    const Outcome tuned =
        runShell("XDG_CACHE_HOME=$PWD grisaille tune " + sponza() + " --camera " +
                     sponzaCamera("atrium") + " --max-error 0.9 --evaluations 1 --size 160x90" +
                     " --samples 32 --json --out t.toml --seed " + seed,
                 folder.path());
    ASSERT_EQ(tuned.status, 0) << tuned.err;
    const json last = json::parse(tuned.out.substr(tuned.out.rfind("{\"evaluations\"")));
    EXPECT_GT(last.at("unseen_rmse").get<double>(), 0.03) << "seed " << seed;
    EXPECT_LT(last.at("unseen_rmse").get<double>(), 0.3) << "seed " << seed;
  }
}

TEST(Tune, MistakesAreNamed) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& more, const std::string& number) {
    const Outcome outcome =
        runShell("XDG_CACHE_HOME=$PWD grisaille tune --out x.toml " + more, folder.path());
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.err.find(number), std::string::npos) << more << "\n" << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.toml"));
    EXPECT_FALSE(std::filesystem::exists(folder / "grisaille/truth"))
        << "the truth was traced before the refusal";
  };
  refused("", "E5101");
  refused("--max-error 0.1 --budget-ms 4", "E5101");
  refused("--max-error -1", "E5101");
  refused("--max-error 0.1 --vary ssao.none", "E3301");
  refused("--max-error 0.1 --vary none.radius", "E3201");
  refused("--max-error 0.1 --camera none.json", "E2201");
  refused("--max-error 0.1 --validate none.json", "E2201");
  refused("--max-error 0.1 --backend metal", "E1002");
}

class PresetTest : public testing::Test {
 protected:
  Outcome render(const std::string& more) const {
    return runShell("grisaille render --size 64x36 --write ao=" + more, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(PresetTest, GivesItsValuesUnderConfigAndSet) {
  const json effects = json::parse(runProgram({"effects", "--json"}, ".").out);
  size_t presets = 0;
  for (const json& effect : effects.at("effects")) {
    const std::string key = effect.at("key");
    for (const json& preset : effect.at("presets")) {
      ++presets;
      EXPECT_GT(preset.at("error").get<double>(), 0);
      std::string sets;
      for (const auto& [name, value] : preset.at("values").items()) {
        sets += " --set " + key + "." + name + "=" + value.get<std::string>();
      }
      if (key != "ssao") continue;
      const std::string name = preset.at("name");
      if (name != "fast" && name != "fine") continue;  // the others take the same code path
      ASSERT_EQ(render("a.exr --preset ssao=" + name).status, 0);
      ASSERT_EQ(render("b.exr" + sets).status, 0);
      EXPECT_EQ(readFile(folder_ / "a.exr"), readFile(folder_ / "b.exr")) << name;
      // --set overrides the preset, wherever it stands.
      ASSERT_EQ(render("c.exr --set ssao.kernel_size=6 --preset ssao=" + name).status, 0);
      ASSERT_EQ(render("d.exr" + sets + " --set ssao.kernel_size=6").status, 0);
      EXPECT_EQ(readFile(folder_ / "c.exr"), readFile(folder_ / "d.exr")) << name;
    }
  }
  EXPECT_GE(presets, 4u);
}

TEST_F(PresetTest, MistakesAreNamed) {
  const auto refused = [&](const std::string& more, const std::string& number) {
    const Outcome outcome = render("x.exr " + more);
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.err.find(number), std::string::npos) << outcome.err;
  };
  refused("--preset ssao", "E5101");
  refused("--preset ssao=best", "E3311");
  refused("--preset none=fast", "E3201");
  refused("--preset sspm=fast", "E3201");  // installed, but not active
}

}  // namespace
}  // namespace grisaille::tests
