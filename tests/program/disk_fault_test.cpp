// SPDX-License-Identifier: MIT
// A full disk, a read-only folder, and a run killed in the middle of a write: saved files stay as
// they were, and the same command continues.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/program/faulty_run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

constexpr const char* kClaim = R"([[claim]]
key = "KEY"
text = "Few are noisier."
source = "A guess."
camera = {eye = [-6.5, 1.75, 1.9], target = [2.6, 2.35, -1.2], fovy_degrees = 62}
size = [32, 18]
runs = [{name = "one"}]
expect = ["one.rmse < 1"]
)";

std::string claimsFile() {
  std::string all;
  for (const char* key : {"first", "second"}) {
    std::string claim = kClaim;
    all += claim.replace(claim.find("KEY"), 3, key);
  }
  return all;
}

class DiskFaults : public testing::TestWithParam<std::string> {
 protected:
  DiskFaults() { fs::create_directory(out()); }

  std::string out() const { return folder_ / "out"; }
  // The truth's cache has its own folder, which fails only in tests that request it.
  std::string cache() const { return folder_ / "cache"; }
  Outcome run(const Words& words, const std::string& fault = "none", int after = 0) const {
    return runIn(out(), words, fault, after);
  }
  Outcome runIn(const std::string& failing, const Words& words, const std::string& fault,
                int after) const {
    Words environment = faulty(fault, after, failing);
    environment.push_back("XDG_CACHE_HOME=" + cache());
    return runProgram(words, folder_.path(), environment);
  }
  Words measure() const {
    return {"measure",   "--sweep",    "ssao.kernel_size=2,4",
            "--size",    "32x18",      "--samples",
            "16",        "--rounds",   "1",
            "--backend", presentOne(), "--out",
            "out/study"};
  }
  Words claims() {
    return {"claims",    folder_.write("claims.toml", claimsFile()),
            "--samples", "16",
            "--backend", presentOne(),
            "--out",     "out/claims"};
  }
  // Both backends treat a disk the same way.
  static std::string presentOne() {
    static const std::string one =
        runProgram({"render", "--backend", "opengl", "--size", "1x1", "--write", "depth=d.exr"},
                   TemporaryFolder().path())
                    .status == 0
            ? "opengl"
            : "vulkan";
    return one;
  }
  // All saved files, without the partial files that a killed process leaves.
  std::vector<std::string> whole() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(out())) {
      if (entry.is_regular_file() && entry.path().extension() != ".part") {
        files.push_back(fs::relative(entry.path(), out()));
      }
    }
    std::ranges::sort(files);
    return files;
  }

  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, DiskFaults, testing::Values("disk_full", "read_only"),
                         [](const auto& of) { return of.param; });

TEST_P(DiskFaults, LeaveWhatIsThereAndSayWhy) {
  const std::string why = GetParam() == "disk_full" ? "No space left" : "Read-only";
  ASSERT_EQ(run({"render", "--size", "16x9", "--write", "depth=d.exr"}).status, 0);
  const Words small = {"--size", "16x9", "--backend", presentOne()};
  const auto with = [&](Words words, const Words& more) {
    words.insert(words.end(), small.begin(), small.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::pair<Words, std::string> commands[] = {
      {with({"render"}, {"--write", "ao=out/a.exr"}), "a.exr"},
      {with({"render"}, {"--timings", "out/t.csv"}), "t.csv"},
      {with({"render"},
            {"--effects", "sspm", "--add", "sspm=8,4,color=#ff0000", "--save", "sspm=out/s.json"}),
       "s.json"},
      {{"apply", "--depth", "d.exr", "--effects", "ssao", "--write", "ao=out/b.exr"}, "b.exr"},
      {{"truth", "--size", "16x9", "--samples", "16", "--write", "ao=out/c.exr"}, "c.exr"},
      {with({"tune", "--max-error", "1"},
            {"--samples", "16", "--evaluations", "1", "--random", "0", "--out", "out/t.toml"}),
       "t.toml"},
      {measure(), "study/records/x.json"},
      {claims(), "claims/claims.json"},
      {{"stability", "--only", "near plane", "--quick", "--backend", presentOne(), "--out",
        "out/stability"},
       "stability/stability.md"},
      {{"new-effect", "mist", "out/mist"}, ""},
      {{"scene", "--write", "out/s.glb"}, "s.glb"}};
  std::vector<std::string> old;
  for (const auto& [words, file] : commands) {
    if (file.empty()) continue;
    fs::create_directories((fs::path(out()) / file).parent_path());
    folder_.write("out/" + file, "precious");
    old.push_back(file);
  }
  std::ranges::sort(old);
  for (const auto& [words, file] : commands) {
    SCOPED_TRACE(words[0] + " " + words.back());
    expectEnds(run(words, GetParam()), 4103, why);
  }
  EXPECT_EQ(whole(), old);
  for (const std::string& file : old) EXPECT_EQ(readFile(out() + "/" + file), "precious") << file;
  for (const auto& entry : fs::recursive_directory_iterator(out())) {
    EXPECT_FALSE(entry.is_regular_file() && entry.path().extension() == ".part") << entry.path();
  }
  EXPECT_FALSE(fs::exists(out() + "/mist"));
}

using DiskFault = DiskFaults;

// Long work does not begin if its result could not be saved.
TEST_F(DiskFault, ReadOnlyFoldersAreRefusedBeforeAnyWork) {
  for (const Words& words :
       {measure(), claims(),
        Words{"tune", "--max-error", "1", "--backend", presentOne(), "--out", "out/t.toml"}}) {
    const Outcome outcome = run(words, "read_only");
    expectEnds(outcome, 4103);
    EXPECT_EQ(outcome.out, "");
  }
}

TEST_F(DiskFault, AStudyKilledInTheMiddleOfAWriteGoesOn) {
  ASSERT_EQ(run(measure()).status, 0);
  const std::vector<std::string> all = whole();
  fs::remove_all(out() + "/study");
  // The kill comes in the record of a setting, after its pictures and the truth's.
  EXPECT_EQ(run(measure(), "killed", 3).status, -1);
  const Outcome outcome = run(measure());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(whole(), all);
}

TEST_F(DiskFault, ClaimsKilledInTheMiddleOfAWriteGoOn) {
  EXPECT_EQ(run(claims(), "killed", 1).status, -1);
  const Outcome outcome = run(claims());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("first holds (measured before)\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("second holds\n"), std::string::npos) << outcome.out;
  const auto json = nlohmann::json::parse(readFile(out() + "/claims/claims.json"));
  EXPECT_EQ(json["backends"][0]["claims"].size(), 2u);
  for (const char* picture : {"first-one.png", "first-truth.png", "second-one.png"}) {
    EXPECT_TRUE(fs::exists(out() + "/claims/pictures/claims/" + picture)) << picture;
  }
  EXPECT_FALSE(fs::exists(out() + "/claims/claims.part"));
}

TEST_F(DiskFault, TruthKilledInTheMiddleOfAWriteKeepsWhatItHad) {
  const auto truth = [](const std::string& samples) {
    return Words{"truth", "--size", "16x9", "--samples", samples, "--write", "ao=t.exr"};
  };
  ASSERT_EQ(run(truth("64")).status, 0);
  EXPECT_EQ(runIn(cache(), truth("128"), "killed", 0).status, -1);
  const Outcome outcome = run(truth("128"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("(64 of them from the cache)"), std::string::npos) << outcome.out;
}

// The old file stays until the new one is complete.
TEST_F(DiskFault, APictureKilledInTheMiddleOfAWriteIsTheOldOne) {
  folder_.write("out/a.exr", "precious");
  EXPECT_EQ(run({"render", "--size", "16x9", "--write", "ao=out/a.exr"}, "killed").status, -1);
  EXPECT_EQ(readFile(out() + "/a.exr"), "precious");
}

TEST(FullOutput, IsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this machine has no /dev/full";
  const TemporaryFolder folder;
  for (const std::string words : {"effects", "render --size 1x1 --timings -", "completion"}) {
    expectEnds(runShell("grisaille " + words + " > /dev/full", folder.path()), 4103,
               "standard output");
  }
}

TEST(LimitOfFileSizes, IsAnErrorLikeAnother) {
  const TemporaryFolder folder;
  expectEnds(runShell("ulimit -f 16; grisaille scene --write a.glb", folder.path()), 4103,
             "File too large");
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace grisaille::tests
