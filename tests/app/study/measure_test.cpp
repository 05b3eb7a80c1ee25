// SPDX-License-Identifier: MIT
// `grisaille measure`, run as users run it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/study/record.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class MeasureTest : public testing::Test {
 protected:
  Outcome measure(std::vector<std::string> more) const {
    std::vector<std::string> all = {"measure",
                                    "--size",
                                    "96x54",
                                    "--samples",
                                    "32",
                                    "--rounds",
                                    "2",
                                    "--sweep",
                                    "ssao.kernel_size=2,16",
                                    "--sweep",
                                    "ssao.radius=0.25,0.5",
                                    "--backend",
                                    "opengl"};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(all, folder_.path(), {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  }
  static std::map<std::string, double> errorsOf(const fs::path& study) {
    std::map<std::string, double> errors;
    for (const auto& record : app::study::loadAll(study)) {
      errors[app::study::nameOf(record.setting)] = record.rmse();
    }
    return errors;
  }
  TemporaryFolder folder_;
};

TEST_F(MeasureTest, GoesOnFromWhatThereIsAndIsTheSameTwice) {
  const Outcome first = measure({"--out", "a"});
  ASSERT_EQ(first.status, 0) << first.err;
  const auto errors = errorsOf(folder_.path() / "a");
  EXPECT_EQ(errors.size(), 4u);
  EXPECT_LT(errors.at("kernel_size=16 radius=0.5"), errors.at("kernel_size=2 radius=0.5"));
  const std::string results = readFile(folder_ / "a/results.json");
  // The results are complete: nothing is measured again.
  ASSERT_EQ(measure({"--out", "a"}).status, 0);
  EXPECT_EQ(readFile(folder_ / "a/results.json"), results);
  // A deleted record is measured again, with the same errors.
  fs::remove(fs::directory_iterator(folder_.path() / "a/records")->path());
  ASSERT_EQ(measure({"--out", "a"}).status, 0);
  EXPECT_EQ(errorsOf(folder_.path() / "a"), errors);
  // Every row of the table has a cell for every heading.
  std::istringstream table(readFile(folder_ / "a/results.csv"));
  std::vector<std::ptrdiff_t> commas;
  for (std::string line; std::getline(table, line);) {
    bool quoted = false;
    commas.push_back(std::ranges::count_if(line, [&](char c) {
      if (c == '"') quoted = !quoted;
      return c == ',' && !quoted;
    }));
  }
  EXPECT_EQ(commas, std::vector<std::ptrdiff_t>(5, commas.at(0)));
  // The page embeds its pictures and loads no other file.
  const std::string page = readFile(folder_ / "a/index.html");
  EXPECT_NE(page.find("data:image/jpeg;base64,/9j/"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  // Its commands render the measured pictures.
  const auto record = app::study::loadAll(folder_.path() / "a").front();
  const Outcome render = runShell(record.command, folder_.path());
  EXPECT_EQ(render.status, 0) << record.command << "\n" << render.err;
}

TEST_F(MeasureTest, PartsMakeTheWhole) {
  ASSERT_EQ(measure({"--out", "whole"}).status, 0);
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    const Outcome outcome = measure({"--out", "parts", "--shard", part});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  EXPECT_EQ(errorsOf(folder_.path() / "parts"), errorsOf(folder_.path() / "whole"));
  // The records are merged by copying.
  fs::create_directories(folder_.path() / "copied");
  fs::copy(folder_.path() / "parts/records", folder_.path() / "copied/records");
  ASSERT_EQ(runProgram({"measure", "--report", "--out", "copied"}, folder_.path()).status, 0);
  EXPECT_EQ(readFile(folder_ / "copied/results.csv"), readFile(folder_ / "parts/results.csv"));
}

// A run may be ended at any time: its records are complete, and the same command continues.
TEST_F(MeasureTest, EndsAtAnyTimeAndGoesOn) {
  constexpr size_t kSettings = 4;
  ASSERT_EQ(measure({"--out", "whole"}).status, 0);
  const std::string command =
      "grisaille measure --size 96x54 --samples 32 --rounds 2 --sweep ssao.kernel_size=2,16 "
      "--sweep "
      "ssao.radius=0.25,0.5 --backend opengl --out ended";
  size_t before = 0;
  for (const char* signal : {"KILL", "INT", "KILL", "TERM"}) {
    // End the run one record later, in the middle of the next setting.
    const std::string line = fmt::format(
        "count() {{ find ended/records -name '*.json' 2>/dev/null | wc -l; }}\n"
        "before=$(count)\n"
        "XDG_CACHE_HOME=$PWD/cache {} &\n"
        "while [ $(count) -le $before ] && kill -0 $!; do sleep 0.02; done\n"
        "kill -s {} $!; wait $!; count",
        command, signal);
    const Outcome outcome = runShell(line, folder_.path());
    const auto records = app::study::loadAll(folder_.path() / "ended");
    EXPECT_GT(records.size(), before) << outcome.err;  // all earlier records are complete, plus one
    before = records.size();
    if (before == kSettings) break;  // finished early on a fast machine
  }
  ASSERT_EQ(measure({"--out", "ended"}).status, 0);
  EXPECT_EQ(errorsOf(folder_.path() / "ended"), errorsOf(folder_.path() / "whole"));
}

TEST_F(MeasureTest, MistakesAreNamed) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& number) {
    std::vector<std::string> all = {"measure", "--out", "x", "--size", "16x16"};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = runProgram(all, folder_.path());
    EXPECT_EQ(outcome.status, number == "5101" ? 2 : 1);
    EXPECT_NE(outcome.err.find("E" + number), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_.path() / "x"));
  };
  refused({"--sweep", "ssao.kernel_size=0"}, "3302");
  refused({"--sweep", "ssao.radius"}, "5101");
  refused({"--shard", "3/2"}, "5101");
  refused({"--backend", "metal"}, "1002");
  refused({"--output", "none"}, "5102");
  refused({"--camera", "missing.json"}, "2201");
  refused({"--effects", "sspm"}, "5101");
}

}  // namespace
}  // namespace grisaille::tests
